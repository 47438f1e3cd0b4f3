//! Golden: Rust gives the rig vectors that Python and TypeScript give too.
#![allow(clippy::unwrap_used, reason = "vectors that cannot be read fail the test")]

use geometry::bound::Options;
use geometry::face::{Iris, Landmarks};
use geometry::fit::fit_pins;
use geometry::point::{Point, from_flat};
use geometry::pose::Pose;
use geometry::pose::channel::CHANNELS;
use geometry::rig::{RestFace, Rig};
use geometry::scene::{Layer, SceneGeometry};
use serde_json::Value;

/// Pixels; the numbers are written to 1e-9.
const TOLERANCE: f64 = 1e-6;

const PARTS: [&str; 8] =
    ["left_eye", "right_eye", "left_iris", "right_iris", "mouth_cavity", "mouth_lower", "tongue", "mouth_upper"];

fn vectors() -> Value {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/vectors/rig/face.json");
    serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
}

/// Numbers of nested lists, in order.
fn flat(value: &Value) -> Vec<f64> {
    match value {
        Value::Array(items) => items.iter().flat_map(flat).collect(),
        number => vec![number.as_f64().unwrap()],
    }
}

fn rest_face(vectors: &Value) -> RestFace {
    let landmarks: Landmarks = from_flat(&flat(&vectors["landmarks"]["points"])).try_into().unwrap();
    let iris = |i: usize| {
        let iris = &vectors["landmarks"]["irises"][i];
        Iris { centre: from_flat(&flat(&iris["centre"]))[0], radius: iris["radius"].as_f64().unwrap() }
    };
    RestFace { landmarks, irises: Some([iris(0), iris(1)]), depth: None }
}

fn rig(vectors: &Value) -> Rig {
    let scene = &vectors["scene"];
    let (mut points, mut segments, mut layers): (Vec<Point>, Vec<usize>, Vec<Layer>) = Default::default();
    for (number, layer) in ["back", "fore", "local"].into_iter().enumerate() {
        for path in scene[layer].as_array().unwrap() {
            let chain = from_flat(&flat(&path["points"]));
            segments.push(chain.len() / 3);
            points.extend(chain);
            let part = path["part"].as_str().map_or(0, |part| PARTS.iter().position(|name| *name == part).unwrap());
            layers.push(Layer::from_number((number + part) as u8).unwrap());
        }
    }
    let (width, height) = (scene["width"].as_f64().unwrap(), scene["height"].as_f64().unwrap());
    let scene = SceneGeometry { width, height, points: &points, segments: &segments, layers: &layers };
    Rig::build(&scene, &rest_face(vectors), Options::default()).unwrap()
}

fn pose(value: &Value) -> Pose {
    let articulators: Vec<f64> =
        CHANNELS.iter().map(|(name, _, _)| value["articulators"][*name].as_f64().unwrap_or(0.0)).collect();
    let offsets = value.get("offsets").map(flat).unwrap_or_default();
    Pose::from_flat(&articulators, &offsets).unwrap()
}

fn assert_near(actual: &[Point], expected: &[Point]) {
    assert_eq!(actual.len(), expected.len());
    let worst = actual.iter().zip(expected).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max);
    assert!(worst < TOLERANCE, "off by {worst} px");
}

#[test]
fn posed_frames_match_the_vectors() {
    let vectors = vectors();
    let rig = rig(&vectors);
    for expected in vectors["frames"].as_array().unwrap() {
        let (vertices, limit) = rig.vertices(&pose(&expected["pose"]));
        assert!((limit.scale - expected["scale"].as_f64().unwrap()).abs() < 1e-9);
        assert_near(&vertices, &from_flat(&flat(&expected["vertices"])));
        let frame = rig.frame(&vertices, rig.rest_vertices()).unwrap();
        assert_eq!(frame.changed.len(), expected["changed"].as_object().unwrap().len());
        for (path, range) in frame.changed.iter().zip(frame.starts.windows(2)) {
            let points = from_flat(&flat(&expected["changed"][path.to_string()]));
            assert_near(&frame.points[range[0]..range[1]], &points);
        }
    }
}

#[test]
fn pins_fit_the_vectors_landmarks() {
    let vectors = vectors();
    let pins = from_flat(&flat(&vectors["pins"])).try_into().unwrap();
    let (landmarks, _) = fit_pins(&pins).unwrap();
    assert_near(&landmarks, &rest_face(&vectors).landmarks);
}
