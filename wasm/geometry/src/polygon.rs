//! Closed polygons: that of a chain of cubics, the area within, and what lies inside.

use crate::cubic::{eval, segment};
use crate::point::Point;

/// Chords by which a cubic is replaced.
const CHORDS: u32 = 8;

/// Points along a closed chain of cubics.
#[must_use]
pub fn polygon(chain: &[Point]) -> Vec<Point> {
    let steps = (0..chain.len() / 3).flat_map(|j| (0..CHORDS).map(move |k| (j, f64::from(k) / f64::from(CHORDS))));
    steps.map(|(j, t)| eval(&segment(chain, j), t)).collect()
}

/// Area within a polygon that does not cross itself.
#[must_use]
pub fn area(polygon: &[Point]) -> f64 {
    0.5 * sides(polygon).map(|(a, b)| a.cross(b)).sum::<f64>().abs()
}

/// Whether a ray from `p` to the right crosses the polygon an odd number of times.
#[must_use]
pub fn contains(polygon: &[Point], p: Point) -> bool {
    let crossed = |(a, b): &(Point, Point)| (a.y > p.y) != (b.y > p.y) && p.x < a.lerp(*b, (p.y - a.y) / (b.y - a.y)).x;
    sides(polygon).filter(crossed).count() % 2 == 1
}

fn sides(polygon: &[Point]) -> impl Iterator<Item = (Point, Point)> {
    polygon.iter().copied().zip(polygon.iter().copied().cycle().skip(1))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn nothing_lies_within_no_points() {
        assert_eq!(area(&polygon(&[])), 0.0);
        assert!(!contains(&[], Point::ZERO));
    }

    proptest! {
        /// Closed form: a point is inside a triangle when it is on the same side of all three edges.
        #[test]
        fn triangle_contains_what_is_on_one_side_of_its_edges(flat in prop::array::uniform8(-9.0..9.0f64)) {
            let [ax, ay, bx, by, cx, cy, px, py] = flat;
            let (corners, p) = ([Point::new(ax, ay), Point::new(bx, by), Point::new(cx, cy)], Point::new(px, py));
            let turns: Vec<f64> = sides(&corners).map(|(a, b)| (b - a).cross(p - a)).collect();
            let inside = turns.iter().all(|&turn| turn > 0.0) || turns.iter().all(|&turn| turn < 0.0);
            prop_assert_eq!(contains(&corners, p), inside);
            let halves = 0.5 * turns.iter().sum::<f64>().abs();
            prop_assert!((area(&corners) - halves).abs() < 1e-9);
        }
    }
}
