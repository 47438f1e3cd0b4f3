//! Triangles over a face, and that no pose turns one over.

use std::collections::BTreeMap;

use geometry::bound::Options;
use geometry::mesh::Mesh;
use geometry::mesh::grid::bounds;
use geometry::opening::Opening;
use geometry::point::Point;
use geometry::pose::Pose;
use geometry::rig::{RestFace, Rig};
use geometry::scene::SceneGeometry;
use proptest::prelude::*;

use crate::scenes::{SIZE, channel_values, face, rig_of};

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

/// Twice the area of the hull of all triangulated vertices, which the outer anchors form.
fn double_hull_area(mesh: &Mesh) -> f64 {
    let used: Vec<Point> = mesh.triangles.iter().flat_map(|t| t.vertices.map(|v| mesh.rest[v])).collect();
    let (low, high) = bounds(&used);
    2.0 * (high.x - low.x) * (high.y - low.y)
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
fn faces_without_extent_are_refused() {
    let scene = SceneGeometry { width: SIZE, height: SIZE, points: &[], segments: &[], layers: &[] };
    let rest = RestFace { landmarks: [Point::new(5.0, 5.0); 68], irises: None, depth: None };
    let error = Rig::build(&scene, &rest, Options::default()).unwrap_err();
    assert_eq!(error.code(), "bad_landmarks");
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
}
