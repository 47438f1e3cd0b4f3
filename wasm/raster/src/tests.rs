//! Properties of the whole: nothing panics, sums are finite, and areas are those of the outlines.

use crate::*;
use proptest::prelude::*;

/// Black solid paths of `segments` straight or curved cubics.
struct Solid {
    points: Vec<f32>,
    segments: usize,
    stops: Vec<f32>,
    axis: Vec<f32>,
    gradient: Vec<bool>,
    clip: Vec<i32>,
}

impl Solid {
    fn new(points: Vec<f32>, segments: usize) -> Self {
        let n = points.len() / (6 * segments);
        let stops = [0.0, 0.0, 0.0, 1.0].repeat(STOPS * n);
        Self { points, segments, stops, axis: vec![0.0; 4 * n], gradient: vec![false; n], clip: vec![-1; n] }
    }

    fn paths(&self) -> Paths<'_> {
        Paths {
            segments: self.segments,
            points: &self.points,
            stops: &self.stops,
            axis: &self.axis,
            gradient: &self.gradient,
            clip: &self.clip,
        }
    }
}

fn frame(width: usize, height: usize, subrows: usize) -> Frame<'static> {
    Frame { width, height, canvas: [1.0; 3], clips: &[], subrows, flatness: FLATNESS, quantise: false }
}

/// A polygon as straight cubics, handles at the thirds.
fn polygon(corners: &[[f32; 2]]) -> Vec<f32> {
    let following = corners.iter().cycle().skip(1);
    let side =
        |(a, b): (&[f32; 2], &[f32; 2])| [0.0, 1.0 / 3.0, 2.0 / 3.0].map(|t| [0, 1].map(|k| a[k] + t * (b[k] - a[k])));
    corners.iter().zip(following).flat_map(side).flatten().collect()
}

/// Covered area of black paint on white.
fn area(corners: &[[f32; 2]], width: usize, height: usize) -> f32 {
    let solid = Solid::new(polygon(corners), corners.len());
    let image = rasterize(&solid.paths(), &frame(width, height, 1), 1).unwrap();
    image.iter().step_by(3).map(|v| 1.0 - v).sum()
}

fn coordinate() -> impl Strategy<Value = f32> {
    prop_oneof![
        -4.0..44.0_f32,
        -65536.0..65536.0_f32,
        Just(0.0),
        Just(-0.0),
        Just(16.0),
        Just(1e-30),
        (0..40).prop_map(|v| v as f32)
    ]
}

proptest! {
    #[test]
    fn wild_paths_neither_panic_nor_give_nan(
        points in prop::collection::vec(coordinate(), 2 * 18),
        (width, height) in (1_usize..40, 1_usize..40),
        subrows in prop::sample::select(vec![1, 2, 4]),
        gradient in prop::bool::ANY,
    ) {
        let mut solid = Solid::new(points.clone(), 3);
        solid.gradient = vec![gradient; 2];
        solid.axis.copy_from_slice(&points[..8]);
        let (target, weight) = (vec![0.5; width * height * 3], vec![1.0; width * height]);
        let target = Target::new(&target, &weight, width, height).unwrap();
        let objective = [Checkpoint { below: 2, target: &target }];
        let frame = frame(width, height, subrows);
        let extras = Extras { importance: true, picture: true, ..Extras::default() };
        let found = differentiate(&solid.paths(), &frame, &Objective::Checkpoints(&objective), extras, 1).unwrap();
        prop_assert!(found.losses.iter().chain(&found.importance).all(|v| v.is_finite()));
        prop_assert!([&found.points, &found.stops, &found.axis].into_iter().flatten().all(|v| v.is_finite()));
        prop_assert!(found.image.iter().all(|v| (-1e-5..1.0 + 1e-5).contains(v)));
        let seen = preview(&solid.paths(), &frame, 1).unwrap();
        prop_assert!(seen.iter().all(|v| (-1e-5..1.0 + 1e-5).contains(v)));
    }

    #[test]
    fn any_input_is_answered_or_refused(points in prop::collection::vec(prop::num::f32::ANY, 0..40), segments in 0_usize..3) {
        let solid = Solid::new(points.clone(), segments.max(1));
        let paths = Paths { segments, ..solid.paths() };
        let _ = rasterize(&paths, &frame(9, 5, 1), 1);
        let _ = preview(&paths, &frame(9, 5, 1), 1);
    }

    #[test]
    fn triangle_covers_half_the_cross_product_of_its_sides(c in prop::array::uniform3([1.0..39.0_f32, 1.0..33.0_f32])) {
        let [[ax, ay], [bx, by], [cx, cy]] = c;
        let expected = 0.5 * ((bx - ax) * (cy - ay) - (by - ay) * (cx - ax)).abs();
        prop_assert!((area(&c, 40, 34) - expected).abs() < 2e-3 + 1e-4 * expected);
    }
}

#[test]
fn rows_below_the_frame_are_not_seen() {
    // 20 rows: the second band is a quarter full; a square from row 10 to row 90 covers 10·8 pixels of the frame.
    assert!((area(&[[2.0, 10.0], [10.0, 10.0], [10.0, 90.0], [2.0, 90.0]], 12, 20) - 80.0).abs() < 1e-4);
}

#[test]
fn preview_rounds_a_side_to_quarters_of_a_pixel_and_ends_to_sub_rows() {
    // From x = 2.3 (9.2 → 9 quarters: three of pixel 2) and y = 1.4 (from sub-row 6 on, whose centre is at 1.625: two of row 1).
    let solid = Solid::new(polygon(&[[2.3, 1.4], [6.0, 1.4], [6.0, 5.0], [2.3, 5.0]]), 4);
    let image = preview(&solid.paths(), &frame(8, 8, 1), 1).unwrap();
    let ink = |row: usize, column: usize| 1.0 - image[3 * (8 * row + column)];
    assert_eq!([ink(2, 1), ink(2, 3), ink(5, 3)], [0.0, 1.0, 0.0]);
    assert!((ink(2, 2) - 0.75).abs() < 0.01, "{}", ink(2, 2));
    assert!((ink(1, 3) - 0.5).abs() < 0.01, "{}", ink(1, 3));
}

#[test]
fn preview_of_a_translucent_blend_is_rounded_up() {
    let mut solid = Solid::new(polygon(&[[-9.0, -9.0], [99.0, -9.0], [99.0, 99.0], [-9.0, 99.0]]), 4);
    for stop in solid.stops.chunks_exact_mut(4) {
        stop[3] = 0.5;
    }
    let image = preview(&solid.paths(), &frame(8, 8, 1), 1).unwrap();
    // Opacity 128: nothing of black, and (255·(255 − 128) + 255) / 256 = 127.5 of white, cut to 127.
    assert!(image.iter().all(|v| (v * 255.0 - 127.0).abs() < 1e-3), "{}", image[0] * 255.0);
}

#[test]
fn zero_area_covers_nothing() {
    assert_eq!(area(&[[3.0, 3.0], [9.0, 7.0]], 12, 12), 0.0);
    assert_eq!(area(&[[3.0, 3.0], [3.0, 3.0], [3.0, 3.0]], 12, 12), 0.0);
}

#[test]
fn refusals_name_value_and_limit() {
    let solid = Solid::new(polygon(&[[0.0, 0.0], [1e6, 0.0], [0.0, 9.0]]), 3);
    let refused = rasterize(&solid.paths(), &frame(8, 8, 1), 1).unwrap_err().to_string();
    assert_eq!(refused, "points holds 333333.34; values must be finite and within ±65536.");
    let refused = rasterize(&solid.paths(), &frame(0, 8, 1), 1).unwrap_err().to_string();
    assert_eq!(refused, "width is 0; the limits are 1 to 4096.");
}
