//! Faces and scenes that are finite and otherwise as bad as can be: every answer is a finite one, or a typed error.

use geometry::bound::Options;
use geometry::face::{Iris, Landmarks};
use geometry::local::Part;
use geometry::opening::N_LANDMARKS;
use geometry::point::Point;
use geometry::pose::Pose;
use geometry::rig::{RestFace, Rig};
use geometry::scene::{Layer, SceneGeometry};
use proptest::prelude::*;

use crate::scenes::{SIZE, blob, blobs, channel_values, face, rig_of};

const EVERYTHING: SceneGeometry = SceneGeometry { width: SIZE, height: SIZE, points: &[], segments: &[], layers: &[] };

fn rest_of(landmarks: Landmarks) -> RestFace {
    RestFace { landmarks, irises: None, depth: None }
}

#[test]
fn path_without_segments_is_refused() {
    let scene = SceneGeometry { segments: &[0], layers: &[Layer::Fore], ..EVERYTHING };
    assert_eq!(Rig::build(&scene, &rest_of(face(0.0)), Options::default()).unwrap_err().code(), "bad_scene");
}

#[test]
fn irises_and_depths_that_are_not_finite_are_refused() {
    let iris = Iris { centre: Point::new(150.0, f64::NAN), radius: 5.0 };
    let blind = RestFace { irises: Some([iris; 2]), ..rest_of(face(0.0)) };
    let flat = RestFace { depth: Some([f64::INFINITY; N_LANDMARKS]), ..rest_of(face(0.0)) };
    for rest in [blind, flat] {
        assert_eq!(Rig::build(&EVERYTHING, &rest, Options::default()).unwrap_err().code(), "bad_landmarks");
    }
}

/// Closed form: parts of an eye without width have no angle to turn by, and go where its corner goes.
#[test]
fn parts_of_an_eye_without_width_go_with_its_corner() {
    let mut landmarks = face(0.0);
    landmarks[39] = landmarks[36];
    let parts =
        [Part::LeftEye, Part::LeftIris].map(|part| (Layer::Local(part), blob(landmarks[36], Point::new(5.0, 5.0))));
    let rig = rig_of(landmarks, &parts, Options::default());
    let vertices: Vec<Point> = rig.rest_vertices().iter().map(|&p| p + Point::new(3.0, 4.0)).collect();
    let frame = rig.frame(&vertices, rig.rest_vertices()).unwrap();
    assert_eq!(frame.changed, [0, 1]);
    for (moved, rest) in frame.points.iter().zip(parts.iter().flat_map(|(_, points)| points)) {
        assert!(moved.distance(*rest + Point::new(3.0, 4.0)) < 1e-9);
    }
}

/// Every path of `blobs`, and one for each part around the middle of its opening.
fn paths(landmarks: &Landmarks) -> Vec<(Layer, Vec<Point>)> {
    let part = |part: Part| {
        let ring = part.opening().ring();
        let middle = ring.iter().fold(Point::ZERO, |sum, &i| sum + landmarks[i]) * (1.0 / ring.len() as f64);
        (Layer::Local(part), blob(middle, Point::new(8.0, 6.0)))
    };
    blobs(Layer::Fore).into_iter().chain(Part::ALL.map(part)).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(96))]

    /// Landmarks that coincide, lie in a line, outside the picture or in a tangle; irises and depths to match.
    #[test]
    fn any_finite_face_moves_finitely_or_is_refused(
        moved in prop::collection::vec((0..N_LANDMARKS, -600.0..600.0f64, -600.0..600.0f64), 0..20),
        merged in prop::collection::vec((0..N_LANDMARKS, 0..N_LANDMARKS), 0..20),
        flattened in prop::collection::vec(0..N_LANDMARKS, 0..30),
        depth in prop::array::uniform::<_, N_LANDMARKS>(-100.0..100.0f64),
        iris in (-600.0..600.0f64, 0.0..100.0f64),
        values in channel_values(),
    ) {
        let mut landmarks = face(0.0);
        for (landmark, dx, dy) in moved {
            landmarks[landmark] += Point::new(dx, dy);
        }
        for landmark in flattened {
            landmarks[landmark].y = 200.0;
        }
        for (from, to) in merged {
            landmarks[from] = landmarks[to];
        }
        let irises = Some([Iris { centre: Point::new(iris.0, 170.0), radius: iris.1 }; 2]);
        let paths = paths(&landmarks);
        let points: Vec<Point> = paths.iter().flat_map(|(_, points)| points.clone()).collect();
        let segments: Vec<usize> = paths.iter().map(|(_, points)| points.len() / 3).collect();
        let layers: Vec<Layer> = paths.iter().map(|(layer, _)| *layer).collect();
        let scene = SceneGeometry { points: &points, segments: &segments, layers: &layers, ..EVERYTHING };
        let Ok(rig) = Rig::build(&scene, &RestFace { landmarks, irises, depth: Some(depth) }, Options::default()) else {
            return Ok(());
        };
        let (vertices, _) = rig.vertices(&Pose::from_flat(&values, &[]).unwrap());
        let frame = rig.frame(&vertices, rig.rest_vertices());
        prop_assert!(frame.is_ok(), "{:?}", frame);
        prop_assert!(frame.unwrap().points.iter().all(|p| p.is_finite()));
        for opening in rig.openings(&vertices) {
            prop_assert!(opening.iter().all(|p| p.is_finite()));
        }
    }
}
