//! Carries a gradient along with its warped path.

use crate::point::Point;

/// Share of the largest displacement up to which a point counts as resting.
const REST: f64 = 0.01;
/// How many moved points a resting one outweighs.
const REST_WEIGHT: f64 = 1e6;

/// Where `points` (ends of a gradient) go under the similarity that best takes a path from `rest` to `warped`: weighted least
/// squares over the control points, read as complex numbers.
///
/// The gradient of a path that rests in part stays with that part, so that no colour changes where nothing moves.
#[must_use]
pub fn follow_path(points: [Point; 2], rest: &[Point], warped: &[Point]) -> [Point; 2] {
    let weights = rest_weights(rest, warped);
    let share = 1.0 / weights.iter().sum::<f64>().max(1.0);
    let centre = |of: &[Point]| of.iter().zip(&weights).fold(Point::ZERO, |sum, (&p, w)| sum + p * (w * share));
    let (from, to) = (centre(rest), centre(warped));
    let (mut moment, mut spread) = (Point::ZERO, 0.0);
    for ((&a, &b), &weight) in rest.iter().zip(warped).zip(&weights) {
        let (a, b) = (a - from, b - to);
        moment += b.complex_mul(Point::new(a.x, -a.y)) * weight;
        spread += a.dot(a) * weight;
    }
    let factor = if spread > 0.0 { moment * (1.0 / spread) } else { Point::new(1.0, 0.0) };
    points.map(|p| to + (p - from).complex_mul(factor))
}

/// Weight of each point: 1 when it moves, `REST_WEIGHT` more when it rests, smoothly in between.
fn rest_weights(rest: &[Point], warped: &[Point]) -> Vec<f64> {
    let squares: Vec<f64> = rest.iter().zip(warped).map(|(&a, &b)| (b - a).dot(b - a)).collect();
    let resting = (REST * REST * squares.iter().copied().fold(0.0, f64::max)).max(f64::MIN_POSITIVE);
    squares.into_iter().map(|square| 1.0 + REST_WEIGHT / (1.0 + (square / resting).powi(3))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_follow_a_similarity_exactly() {
        let rest = [(0.0, 0.0), (4.0, 1.0), (2.0, 5.0)].map(|(x, y)| Point::new(x, y));
        let (turn, shift) = (Point::new(0.6, 1.2), Point::new(-3.0, 7.0));
        let warped = rest.map(|p| p.complex_mul(turn) + shift);
        let ends = [Point::new(9.0, 9.0), Point::new(-1.0, 2.0)];
        for (end, there) in ends.into_iter().zip(follow_path(ends, &rest, &warped)) {
            assert!(there.distance(end.complex_mul(turn) + shift) < 1e-12);
        }
    }

    #[test]
    fn ends_stay_where_a_third_of_the_path_rests() {
        let rest: Vec<Point> = (0..12u8).map(|i| Point::new(f64::from(i * i), f64::from(i))).collect();
        let mut warped = rest.clone();
        for p in &mut warped[4..] {
            p.y += 20.0;
        }
        let ends = [rest[0], rest[11]];
        for (end, there) in ends.into_iter().zip(follow_path(ends, &rest, &warped)) {
            assert!(there.distance(end) < 0.05, "{there:?} for {end:?}");
        }
    }
}
