//! Faces, scenes and rigs that the tests are about.

use std::collections::BTreeMap;

use geometry::bound::Options;
use geometry::face::Landmarks;
use geometry::fit::fit_pins;
use geometry::opening::Opening;
use geometry::point::Point;
use geometry::pose::{Channel, Pose};
use geometry::rig::{RestFace, Rig};
use geometry::scene::{Layer, SceneGeometry};
use proptest::prelude::*;

pub const SIZE: f64 = 400.0;

/// Face of a template, its lips apart by `gape` pixels.
pub fn face(gape: f64) -> Landmarks {
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
pub fn blob(centre: Point, radius: Point) -> Vec<Point> {
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

pub fn rig_of(landmarks: Landmarks, paths: &[(Layer, Vec<Point>)], options: Options) -> Rig {
    let points: Vec<Point> = paths.iter().flat_map(|(_, points)| points.clone()).collect();
    let segments: Vec<usize> = paths.iter().map(|(_, points)| points.len() / 3).collect();
    let layers: Vec<Layer> = paths.iter().map(|(layer, _)| *layer).collect();
    let scene = SceneGeometry { width: SIZE, height: SIZE, points: &points, segments: &segments, layers: &layers };
    Rig::build(&scene, &RestFace { landmarks, irises: None, depth: None }, options).unwrap()
}

pub fn blobs(layer: Layer) -> Vec<(Layer, Vec<Point>)> {
    let at = |i: f64| Point::new(120.0 + 23.0 * (i * 7.0 % 8.0), 130.0 + 21.0 * i);
    (0..9).map(|i| (layer, blob(at(f64::from(i)), Point::new(30.0 + f64::from(i), 22.0)))).collect()
}

pub fn warped(rig: &Rig, vertices: &[Point]) -> BTreeMap<usize, Vec<Point>> {
    let frame = rig.frame(vertices, rig.rest_vertices()).unwrap();
    let ranges = frame.starts.windows(2).map(|range| frame.points[range[0]..range[1]].to_vec());
    frame.changed.iter().copied().zip(ranges).collect()
}

pub fn pose_of(rig: &Rig, channels: &[(Channel, f64)]) -> Vec<Point> {
    rig.vertices(&Pose::of(channels)).0
}

pub fn channel_values() -> impl Strategy<Value = Vec<f64>> {
    geometry::pose::channel::CHANNELS.map(|(_, least, greatest)| least..=greatest).to_vec()
}
