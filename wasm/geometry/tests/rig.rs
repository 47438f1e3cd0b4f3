//! Properties of whole rigs: topology, splitting, binding, poses.
#![allow(clippy::unwrap_used, reason = "a rig that cannot be built fails the test")]

use std::collections::BTreeMap;

use geometry::bound::Options;
use geometry::cubic::{eval, segment, signed_area};
use geometry::face::Landmarks;
use geometry::fit::fit_pins;
use geometry::joints::largest_kink;
use geometry::local::Part;
use geometry::mesh::Mesh;
use geometry::mesh::grid::{Grid, bounds};
use geometry::opening::Opening;
use geometry::point::Point;
use geometry::pose::{Channel, Pose};
use geometry::rig::{RestFace, Rig};
use geometry::scene::{Layer, SceneGeometry};
use geometry::split::{Anchor, split_path};
use proptest::prelude::*;

const SIZE: f64 = 400.0;

/// Face of a template, its lips apart by `gape` pixels.
fn face(gape: f64) -> Landmarks {
    let pins = [(150.0, 160.0), (250.0, 165.0), (200.0, 220.0), (165.0, 265.0), (237.0, 268.0)];
    let (mut landmarks, _) = fit_pins(&pins.map(|(x, y)| Point::new(x, y))).unwrap();
    for (upper, lower) in Opening::Mouth.pairs() {
        let middle = landmarks[upper].lerp(landmarks[lower], 0.5);
        landmarks[upper] = middle - Point::new(0.0, gape / 2.0);
        landmarks[lower] = middle + Point::new(0.0, gape / 2.0);
    }
    landmarks
}

/// Closed chain of four arcs.
fn blob(centre: Point, radius: Point) -> Vec<Point> {
    let k = 0.552_284_75;
    [
        (1., 0.),
        (1., k),
        (k, 1.),
        (0., 1.),
        (-k, 1.),
        (-1., k),
        (-1., 0.),
        (-1., -k),
        (-k, -1.),
        (0., -1.),
        (k, -1.),
        (1., -k),
    ]
    .map(|(x, y)| centre + Point::new(x * radius.x, y * radius.y))
    .to_vec()
}

fn rig_of(landmarks: Landmarks, paths: &[(Layer, Vec<Point>)], options: Options) -> Rig {
    let points: Vec<Point> = paths.iter().flat_map(|(_, points)| points.clone()).collect();
    let segments: Vec<usize> = paths.iter().map(|(_, points)| points.len() / 3).collect();
    let layers: Vec<Layer> = paths.iter().map(|(layer, _)| *layer).collect();
    let scene = SceneGeometry { width: SIZE, height: SIZE, points: &points, segments: &segments, layers: &layers };
    Rig::build(&scene, &RestFace { landmarks, irises: None, depth: None }, options).unwrap()
}

fn blobs(layer: Layer) -> Vec<(Layer, Vec<Point>)> {
    let at = |i: f64| Point::new(120.0 + 23.0 * (i * 7.0 % 8.0), 130.0 + 21.0 * i);
    (0..9).map(|i| (layer, blob(at(f64::from(i)), Point::new(30.0 + f64::from(i), 22.0)))).collect()
}

fn warped(rig: &Rig, vertices: &[Point]) -> BTreeMap<usize, Vec<Point>> {
    let frame = rig.frame(vertices, rig.rest_vertices()).unwrap();
    let ranges = frame.starts.windows(2).map(|range| frame.points[range[0]..range[1]].to_vec());
    frame.changed.iter().copied().zip(ranges).collect()
}

fn pose_of(rig: &Rig, channels: &[(Channel, f64)]) -> Vec<Point> {
    rig.vertices(&Pose::of(channels)).0
}

/// Twice the area of the hull of all triangulated vertices, which the outer anchors form.
fn double_hull_area(mesh: &Mesh) -> f64 {
    let used: Vec<Point> = mesh.triangles.iter().flat_map(|t| t.vertices.map(|v| mesh.rest[v])).collect();
    let (low, high) = bounds(&used);
    2.0 * (high.x - low.x) * (high.y - low.y)
}

#[test]
fn triangles_cover_the_hull_once_at_every_scale() {
    for gape in [0.0, 15.0] {
        let mut shapes = Vec::new();
        for scale in [2f64.powi(-7), 1.0, 2f64.powi(20)] {
            let landmarks = face(gape).map(|p| p * scale);
            let scene =
                SceneGeometry { width: SIZE * scale, height: SIZE * scale, points: &[], segments: &[], layers: &[] };
            let rig =
                Rig::build(&scene, &RestFace { landmarks, irises: None, depth: None }, Options::default()).unwrap();
            let mesh = rig.mesh();
            let areas: Vec<f64> = (0..mesh.triangles.len()).map(|t| mesh.double_area(t, &mesh.rest)).collect();
            let total = double_hull_area(mesh);
            assert!(areas.iter().all(|&area| area > 0.0));
            assert!((areas.iter().sum::<f64>() / total - 1.0).abs() < 1e-12);
            let mut half_edges = BTreeMap::new();
            for [a, b, c] in mesh.triangles.iter().map(|t| t.vertices) {
                for edge in [(a, b), (b, c), (c, a)] {
                    *half_edges.entry(edge).or_insert(0) += 1;
                }
            }
            assert!(half_edges.values().all(|&n| n == 1), "a directed edge belongs to one triangle");
            shapes.push(mesh.triangles.clone());
        }
        assert!(shapes[0] == shapes[1] && shapes[1] == shapes[2], "the same triangles at every scale");
    }
}

#[test]
fn closed_mouth_is_a_slit_without_triangles_across() {
    let rig = rig_of(face(0.0), &[], Options::default());
    let (upper, lower) = ([49, 50, 51, 52, 53, 61, 62, 63], [55, 56, 57, 58, 59, 65, 66, 67]);
    for triangle in &rig.mesh().triangles {
        assert_eq!(triangle.interior.filter(|opening| *opening == Opening::Mouth), None);
        let on = |lip: &[usize]| triangle.vertices.iter().any(|vertex| lip.contains(vertex));
        assert!(!(on(&upper) && on(&lower)), "{:?} spans both lips", triangle.vertices);
    }
    for inner in [61, 62, 63, 65, 66, 67] {
        assert!(rig.mesh().triangles.iter().any(|triangle| triangle.vertices.contains(&inner)));
    }
}

#[test]
fn lip_paths_go_with_their_own_lip() {
    let landmarks = face(0.0);
    let lip = |a: usize, b: usize| blob(landmarks[a].lerp(landmarks[b], 0.5), Point::new(4.0, 1.5));
    let rig = rig_of(landmarks, &[(Layer::Fore, lip(62, 51)), (Layer::Fore, lip(66, 57))], Options::default());
    let moved = warped(&rig, &pose_of(&rig, &[(Channel::Jaw, 1.0)]));
    let drop = |path: usize| moved.get(&path).map_or(0.0, |points| points[0].y - rig.paths().rest_path(path)[0].y);
    assert!(drop(0) < 1.0 && drop(1) > 10.0, "upper lip {} px, lower lip {} px", drop(0), drop(1));
}

#[test]
fn pieces_rejoin_to_the_source_and_lie_in_their_triangles() {
    let rig = rig_of(face(12.0), &[], Options::default());
    let mesh = rig.mesh();
    let grid = Grid::new(mesh, Point::ZERO, Point::new(SIZE, SIZE));
    for (_, source) in blobs(Layer::Fore) {
        let path = split_path(&source, mesh, &grid);
        assert!(path.anchors.len() > source.len() / 3, "the blobs cross edges");
        let mut pieces = 0..path.anchors.len();
        let mut piece = pieces.next();
        for j in 0..source.len() / 3 {
            // All pieces up to the next source anchor trace segment j.
            let curve = segment(&source, j);
            let mut last = 0.0;
            while let Some(k) = piece {
                for u in [0.0, 0.25, 0.5, 0.75, 1.0] {
                    let p = eval(&segment(&path.points, k), u);
                    let (t, distance) = nearest(&curve, p, last);
                    assert!(distance < 1e-9, "piece {k} leaves segment {j} by {distance}");
                    last = t;
                }
                let middle = eval(&segment(&path.points, k), 0.5);
                let triangle = path.triangles[k].unwrap(); // no bridge: this mouth is open
                let depth = mesh.barycentric(triangle, middle).into_iter().fold(f64::INFINITY, f64::min);
                assert!(depth >= -1e-12, "piece {k} lies outside its triangle by {depth}");
                piece = pieces.next();
                if piece.is_none_or(|next| path.anchors[next] == Anchor::Source) {
                    break;
                }
            }
        }
    }
}

/// Parameter at or after `from` of the curve's point nearest to `p`, and its distance: ternary search around samples.
fn nearest(curve: &[Point; 4], p: Point, from: f64) -> (f64, f64) {
    let distance = |t: f64| eval(curve, t).distance(p);
    let samples = (0..=400).map(|i| from + (1.0 - from) * f64::from(i) / 400.0);
    let best = samples.min_by(|&a, &b| distance(a).total_cmp(&distance(b))).unwrap();
    let (mut low, mut high) = ((best - 0.005).max(0.0), (best + 0.005).min(1.0));
    for _ in 0..100 {
        let (a, b) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
        if distance(a) < distance(b) { high = b } else { low = a }
    }
    (low, distance(low))
}

#[test]
fn back_paths_never_move_and_fore_paths_keep_their_commands() {
    let mut paths = blobs(Layer::Back);
    paths.extend(blobs(Layer::Fore));
    let rig = rig_of(face(12.0), &paths, Options::default());
    let everything: Vec<(Channel, f64)> = [
        (Channel::Jaw, 0.8),
        (Channel::Smile, 0.6),
        (Channel::BlinkLeft, 1.0),
        (Channel::Yaw, 15.0),
        (Channel::Roll, -10.0),
    ]
    .to_vec();
    let moved = warped(&rig, &pose_of(&rig, &everything));
    assert!(moved.keys().all(|&path| path >= 9));
    for (path, points) in moved {
        assert_eq!(points.len(), rig.paths().rest_path(path).len());
    }
}

#[test]
fn kinks_at_split_joints_are_repaired() {
    let paths = blobs(Layer::Fore);
    let pose = [(Channel::Jaw, 0.7), (Channel::Smile, 0.8)];
    let kink = |smooth: bool| {
        let rig = rig_of(face(12.0), &paths, Options { split: true, smooth });
        let moved = warped(&rig, &pose_of(&rig, &pose));
        let joints = |path: usize| {
            let grid = Grid::new(rig.mesh(), Point::ZERO, Point::new(SIZE, SIZE));
            geometry::joints::smooth_joints(&split_path(&paths[path].1, rig.mesh(), &grid), rig.mesh())
        };
        moved.iter().map(|(&path, points)| largest_kink(points, &joints(path))).fold(0.0, f64::max)
    };
    assert!(kink(false) > 5.0);
    assert!(kink(true) < 1e-6);
}

#[test]
fn upper_teeth_stay_and_lower_teeth_drop_unstretched() {
    let landmarks = face(0.0);
    let teeth = blob(landmarks[62] + Point::new(0.0, 3.0), Point::new(14.0, 4.0));
    let paths = [(Layer::Local(Part::MouthUpper), teeth.clone()), (Layer::Local(Part::MouthLower), teeth.clone())];
    let rig = rig_of(landmarks, &paths, Options::default());
    let moved = warped(&rig, &pose_of(&rig, &[(Channel::Jaw, 1.0), (Channel::Smile, 0.5)]));
    assert_eq!(moved.keys().copied().collect::<Vec<_>>(), [1]);
    assert!((signed_area(&moved[&1]) / signed_area(&teeth) - 1.0).abs() < 1e-9);
    assert!(moved[&1][0].y - teeth[0].y > 10.0);
}

#[test]
fn iris_keeps_its_shape_and_full_blink_closes_exactly() {
    let landmarks = face(0.0);
    let centre = landmarks[37].lerp(landmarks[40], 0.5);
    let paths = [(Layer::Local(Part::LeftIris), blob(centre, Point::new(6.0, 6.0)))];
    let rig = rig_of(landmarks, &paths, Options::default());
    for pose in
        [vec![(Channel::GazeX, 1.0), (Channel::GazeY, 0.5)], vec![(Channel::Yaw, 15.0)], vec![(Channel::Roll, 15.0)]]
    {
        let iris = &warped(&rig, &pose_of(&rig, &pose))[&0];
        let (across, along) = (iris[0].distance(iris[6]), iris[3].distance(iris[9]));
        assert!((across / along - 1.0).abs() < 1e-9, "a circle stays a circle");
    }
    let blink = pose_of(&rig, &[(Channel::BlinkLeft, 1.0), (Channel::BlinkRight, 1.0)]);
    assert!(warped(&rig, &blink).is_empty(), "the eyeball is not squeezed");
    for outline in &rig.openings(&blink)[..2] {
        assert!(signed_area(outline).abs() < 1e-9);
    }
}

#[test]
fn lids_stay_in_their_socket_and_lashes_close_over_them() {
    let landmarks = face(0.0);
    let eye = landmarks[37].lerp(landmarks[40], 0.5);
    let paths =
        [(Layer::Fore, blob(eye, Point::new(3.0, 2.0))), (Layer::Fore, blob(landmarks[37], Point::new(3.0, 2.0)))];
    let rig = rig_of(landmarks, &paths, Options::default());
    let moved = warped(&rig, &pose_of(&rig, &[(Channel::BlinkLeft, 1.0)]));
    assert_eq!(moved.keys().copied().collect::<Vec<_>>(), [1]);
}

/// Lids that close aslant, under low brows, carry their bands across those of the brows.
#[test]
fn slanting_eyes_under_low_brows_close_fully() {
    let mut landmarks = face(0.0);
    for brow in &mut landmarks[17..27] {
        brow.y += 9.0;
    }
    for (upper, shift) in [(37, 0.0), (38, -7.0), (43, 7.0), (44, 0.0)] {
        landmarks[upper].x += shift;
    }
    let rig = rig_of(landmarks, &[], Options::default());
    let (vertices, limit) = rig.vertices(&Pose::of(&[(Channel::BlinkLeft, 1.0), (Channel::BlinkRight, 1.0)]));
    assert_eq!(limit.scale, 1.0);
    for outline in &rig.openings(&vertices)[..2] {
        assert!(signed_area(outline).abs() < 1e-9);
    }
}

#[test]
fn without_splitting_points_follow_their_own_triangles() {
    let paths = blobs(Layer::Fore);
    let rig = rig_of(face(12.0), &paths, Options { split: false, smooth: true });
    for (path, (_, source)) in paths.iter().enumerate() {
        assert_eq!(rig.paths().rest_path(path), source);
    }
}

/// Pieces of a path as they stand at rest and as they are warped, with their triangles.
fn pieces<'a>(
    rig: &Rig,
    source: &[Point],
    rest: &'a [Point],
    warped: &'a [Point],
) -> Vec<(usize, [Point; 4], [Point; 4])> {
    let grid = Grid::new(rig.mesh(), Point::ZERO, Point::new(SIZE, SIZE));
    let path = split_path(source, rig.mesh(), &grid);
    assert_eq!(path.points, rest);
    let inside = path.triangles.iter().enumerate().filter_map(|(k, triangle)| Some((k, (*triangle)?)));
    inside.map(|(k, triangle)| (triangle, segment(rest, k), segment(warped, k))).collect()
}

/// Blobs all over the face, and one across both lips.
fn crowded_face(landmarks: &Landmarks) -> Vec<(Layer, Vec<Point>)> {
    let mut paths = blobs(Layer::Fore);
    paths.push((Layer::Fore, blob(landmarks[62].lerp(landmarks[66], 0.5), Point::new(30.0, 25.0))));
    paths
}

fn channel_values() -> impl Strategy<Value = Vec<f64>> {
    geometry::pose::channel::CHANNELS.map(|(_, least, greatest)| least..=greatest).to_vec()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn no_pose_turns_a_triangle_over(values in channel_values(), dx in -0.6..0.6, dy in -0.6..0.6, landmark in 0usize..68) {
        let rig = rig_of(face(0.0), &[], Options::default());
        let mut offsets = vec![0.0; 136];
        offsets[2 * landmark] = dx;
        offsets[2 * landmark + 1] = dy;
        let (vertices, limit) = rig.vertices(&Pose::from_flat(&values, &offsets).unwrap());
        prop_assert!(limit.scale > 0.0 && limit.scale <= 1.0);
        for (index, triangle) in rig.mesh().triangles.iter().enumerate() {
            prop_assert!(triangle.interior.is_some() || rig.mesh().double_area(index, &vertices) > 0.0);
        }
    }

    /// Dragging landmarks moves the pieces in their own triangles, and those alone: all others stay to the last bit.
    #[test]
    fn pieces_in_triangles_that_rest_keep_their_rest_geometry(landmark in 0usize..68, dx in -0.2..0.2f64, dy in -0.2..0.2f64, gape in prop::sample::select(vec![0.0, 12.0])) {
        prop_assume!(dx.hypot(dy) > 0.01);
        let landmarks = face(gape);
        let paths = crowded_face(&landmarks);
        let rig = rig_of(landmarks, &paths, Options::default());
        let mut offsets = vec![0.0; 136];
        offsets[2 * landmark..2 * landmark + 2].copy_from_slice(&[dx, dy]);
        let (vertices, _) = rig.vertices(&Pose::from_flat(&[0.0; geometry::pose::channel::CHANNELS.len()], &offsets).unwrap());
        let moved = |triangle: usize| rig.mesh().triangles[triangle].vertices.iter().any(|&v| vertices[v] != rig.rest_vertices()[v]);
        let mut n_moved = 0;
        for (path, points) in warped(&rig, &vertices) {
            for (triangle, rest, now) in pieces(&rig, &paths[path].1, rig.paths().rest_path(path), &points) {
                n_moved += usize::from(rest != now);
                prop_assert!(moved(triangle) || rest == now, "path {path} moves in triangle {triangle}, which rests");
            }
        }
        prop_assert!(n_moved > 0 || !(48..68).contains(&landmark), "a blob lies over the mouth");
    }

    #[test]
    fn affine_maps_of_the_vertices_are_affine_maps_of_the_paths(m in prop::array::uniform4(-2.0..2.0f64), x in -50.0..50.0, y in -50.0..50.0) {
        prop_assume!((m[0] * m[3] - m[1] * m[2]).abs() > 0.1);
        let map = |p: Point| Point::new(m[0] * p.x + m[1] * p.y + x, m[2] * p.x + m[3] * p.y + y);
        let rig = rig_of(face(12.0), &blobs(Layer::Fore), Options::default());
        let vertices: Vec<Point> = rig.rest_vertices().iter().map(|&p| map(p)).collect();
        for (path, points) in warped(&rig, &vertices) {
            for (warped, &rest) in points.iter().zip(rig.paths().rest_path(path)) {
                prop_assert!(warped.distance(map(rest)) < 1e-9 * SIZE);
            }
        }
    }

    /// Two paths with a common border part along it nowhere: its points, split points too, are the same numbers.
    #[test]
    fn paths_that_share_a_curve_share_its_points(values in channel_values()) {
        let first = blob(Point::new(200.0, 230.0), Point::new(70.0, 60.0));
        let mut second = first.clone();
        for p in &mut second[7..12] {
            p.y -= 40.0; // the two segments from 6 on; those before are common
        }
        let paths = [(Layer::Fore, first), (Layer::Fore, second)];
        let rig = rig_of(face(12.0), &paths, Options { split: true, smooth: false });
        let common = |a: &[Point], b: &[Point]| a.iter().zip(b).take_while(|(p, q)| p == q).count();
        let (a, b) = (rig.paths().rest_path(0), rig.paths().rest_path(1));
        let shared = common(a, b);
        prop_assert!(shared > 7, "{shared}: the common segments cross edges");
        let moved = warped(&rig, &rig.vertices(&Pose::from_flat(&values, &[]).unwrap()).0);
        if let (Some(a), Some(b)) = (moved.get(&0), moved.get(&1)) {
            prop_assert!(common(a, b) >= shared);
        }
    }

    #[test]
    fn warp_is_linear_in_the_vertices(values in channel_values(), share in 0.0..1.0) {
        let rig = rig_of(face(12.0), &blobs(Layer::Fore), Options { split: true, smooth: false });
        let posed = rig.vertices(&Pose::from_flat(&values, &[]).unwrap()).0;
        let between: Vec<Point> = rig.rest_vertices().iter().zip(&posed).map(|(&a, &b)| a.lerp(b, share)).collect();
        let (whole, part) = (warped(&rig, &posed), warped(&rig, &between));
        for (path, points) in part {
            for (k, p) in points.iter().enumerate() {
                prop_assert!(p.distance(rig.paths().rest_path(path)[k].lerp(whole[&path][k], share)) < 1e-9);
            }
        }
    }
}

#[test]
fn zero_pose_is_rest_bit_for_bit() {
    let rig = rig_of(face(12.0), &blobs(Layer::Fore), Options::default());
    let (vertices, limit) = rig.vertices(&Pose::default());
    assert_eq!(vertices, rig.rest_vertices());
    assert_eq!(limit.scale, 1.0);
    assert!(warped(&rig, &vertices).is_empty());
}

/// Closed form: the middle pair of inner lips meets, and the jaw then opens as far as that of a mouth at rest closed.
#[test]
fn neutral_closes_a_mouth_that_rests_open() {
    let rig = rig_of(face(14.0), &blobs(Layer::Fore), Options::default());
    let rest = pose_of(&rig, &[]);
    assert!(rest[66].y - rest[62].y > 10.0, "the source's mouth is open");
    let neutral = pose_of(&rig, &[(Channel::Neutral, 1.0)]);
    assert!((neutral[66].y - neutral[62].y).abs() < 1e-9);
    assert_eq!(neutral[60], rest[60], "corners stay");
    let spoken = pose_of(&rig, &[(Channel::Neutral, 1.0), (Channel::Jaw, 0.2)]);
    let opened = pose_of(&rig, &[(Channel::Jaw, 0.2)]);
    assert!(spoken[66].y < opened[66].y, "a track opens the mouth from closed, not from its rest");
}

#[test]
fn faces_without_extent_are_refused() {
    let scene = SceneGeometry { width: SIZE, height: SIZE, points: &[], segments: &[], layers: &[] };
    let rest = RestFace { landmarks: [Point::new(5.0, 5.0); 68], irises: None, depth: None };
    let error = Rig::build(&scene, &rest, Options::default()).unwrap_err();
    assert_eq!(error.code(), "bad_landmarks");
}
