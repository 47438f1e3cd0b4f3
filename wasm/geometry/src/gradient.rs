//! Carries a gradient along with its warped path.

use crate::point::Point;

/// Where `points` (ends of a gradient) go under the similarity that best takes a path from `rest` to `warped`
/// (least squares over the control points, read as complex numbers).
#[must_use]
pub fn follow_path(points: [Point; 2], rest: &[Point], warped: &[Point]) -> [Point; 2] {
    let share = 1.0 / rest.len().max(1) as f64;
    let centre = |of: &[Point]| of.iter().fold(Point::ZERO, |sum, &p| sum + p * share);
    let (from, to) = (centre(rest), centre(warped));
    let (mut moment, mut spread) = (Point::ZERO, 0.0);
    for (&a, &b) in rest.iter().zip(warped) {
        let (a, b) = (a - from, b - to);
        moment += b.complex_mul(Point::new(a.x, -a.y));
        spread += a.dot(a);
    }
    let factor = if spread > 0.0 { moment * (1.0 / spread) } else { Point::new(1.0, 0.0) };
    points.map(|p| to + (p - from).complex_mul(factor))
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
}
