//! Fore paths: split at the mesh's edges, bound to its triangles, warped with them.

use geometry::bound::Options;
use geometry::cubic::{eval, segment};
use geometry::face::Landmarks;
use geometry::joints::{largest_kink, smooth_joints};
use geometry::mesh::grid::Grid;
use geometry::point::Point;
use geometry::pose::{Channel, Pose};
use geometry::rig::Rig;
use geometry::scene::Layer;
use geometry::split::{Anchor, split_path};
use proptest::prelude::*;

use crate::scenes::{SIZE, blob, blobs, channel_values, face, pose_of, rig_of, warped};

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
fn lip_paths_go_with_their_own_lip() {
    let landmarks = face(0.0);
    let lip = |a: usize, b: usize| blob(landmarks[a].lerp(landmarks[b], 0.5), Point::new(4.0, 1.5));
    let rig = rig_of(landmarks, &[(Layer::Fore, lip(62, 51)), (Layer::Fore, lip(66, 57))], Options::default());
    let moved = warped(&rig, &pose_of(&rig, &[(Channel::Jaw, 1.0)]));
    let drop = |path: usize| moved.get(&path).map_or(0.0, |points| points[0].y - rig.paths().rest_path(path)[0].y);
    assert!(drop(0) < 1.0 && drop(1) > 10.0, "upper lip {} px, lower lip {} px", drop(0), drop(1));
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
            smooth_joints(&split_path(&paths[path].1, rig.mesh(), &grid), rig.mesh())
        };
        moved.iter().map(|(&path, points)| largest_kink(points, &joints(path))).fold(0.0, f64::max)
    };
    assert!(kink(false) > 5.0);
    assert!(kink(true) < 1e-6);
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

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

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
