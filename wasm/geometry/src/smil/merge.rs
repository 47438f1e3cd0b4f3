//! Undoes splits that a motion does not need: pieces of one cubic become that cubic again where its triangles move alike.

use super::keyframes::Trajectory;
use crate::point::Point;

/// Split parameters nearer to an end than this would blow rounding up.
const END: f64 = 0.02;

/// A cubic over time, and how far it is from the pieces it stands for at most.
struct Piece {
    /// Start, two handles and end, frame by frame.
    frames: Vec<[Point; 4]>,
    error: f64,
}

/// The closed chains of `trajectory` with as few cubics as lie within `tolerance` of it in every frame, point by point of
/// equal parameters, and within `at_start` in the first. Linear in the points, with the same weights in all frames.
#[must_use]
pub fn merged(trajectory: &Trajectory, at_start: f64, tolerance: f64) -> Trajectory {
    let n_points = trajectory.first().map_or(0, Vec::len);
    let mut pieces: Vec<Piece> = Vec::new();
    for start in (0..n_points).step_by(3) {
        let cubic = |points: &Vec<Point>| [0, 1, 2, 3].map(|k| points[(start + k) % n_points]);
        let next = Piece { frames: trajectory.iter().map(cubic).collect(), error: 0.0 };
        let joined = pieces.last().and_then(|last| join(last, &next, at_start, tolerance));
        match (joined, pieces.last_mut()) {
            (Some(joined), Some(last)) => *last = joined,
            _ => pieces.push(next),
        }
    }
    let chain = |frame| pieces.iter().flat_map(|piece: &Piece| piece.frames[frame][..3].to_vec()).collect();
    (0..trajectory.len()).map(chain).collect()
}

/// The one cubic that `a` and `b` are pieces of, if there is one.
fn join(a: &Piece, b: &Piece, at_start: f64, tolerance: f64) -> Option<Piece> {
    let (first, second) = (a.frames.first()?, b.frames.first()?);
    // de Casteljau: the handles beside a split lie as far from it as the parameters before and after
    let (before, after) = (first[2].distance(first[3]), second[0].distance(second[1]));
    let t = before / (before + after);
    if !(END..1.0 - END).contains(&t) {
        return None;
    }
    let mut joined = Piece { frames: Vec::with_capacity(a.frames.len()), error: 0.0 };
    for (frame, (p, q)) in a.frames.iter().zip(&b.frames).enumerate() {
        let handle = p[0] + (p[1] - p[0]) * (1.0 / t);
        let other = q[3] + (q[2] - q[3]) * (1.0 / (1.0 - t));
        let middle = handle.lerp(other, t);
        let (left, right) = (p[1].lerp(middle, t), middle.lerp(q[2], t));
        let misses = [left.distance(p[2]), right.distance(q[1]), left.lerp(right, t).distance(p[3])];
        let error = a.error.max(b.error) + misses.into_iter().fold(0.0, f64::max);
        if error > tolerance || (frame == 0 && error > at_start) {
            return None;
        }
        joined.error = joined.error.max(error);
        joined.frames.push([p[0], handle, other, q[3]]);
    }
    Some(joined)
}

#[cfg(test)]
mod tests {
    use super::*;

    const CHAIN: [[f64; 2]; 6] = [[0.0, 0.0], [40.0, -30.0], [90.0, 10.0], [100.0, 80.0], [60.0, 120.0], [-20.0, 70.0]];

    fn split(points: &[Point], t: f64) -> Vec<Point> {
        let n = points.len();
        let halves = (0..n).step_by(3).flat_map(|start| {
            let [a, b, c, d] = [0, 1, 2, 3].map(|k| points[(start + k) % n]);
            let (ab, bc, cd) = (a.lerp(b, t), b.lerp(c, t), c.lerp(d, t));
            let (left, right) = (ab.lerp(bc, t), bc.lerp(cd, t));
            [a, ab, left, left.lerp(right, t), right, cd]
        });
        halves.collect()
    }

    fn moving(warp: impl Fn(usize, Point) -> Point) -> Trajectory {
        let rest: Vec<Point> = CHAIN.iter().map(|p| Point::new(p[0], p[1])).collect();
        let pieces = split(&split(&rest, 0.3), 0.6);
        (0..5).map(|frame| pieces.iter().map(|&p| warp(frame, p)).collect()).collect()
    }

    #[test]
    fn affine_motion_needs_no_split() {
        let trajectory =
            moving(|frame, p| Point::new(p.x + 0.1 * frame as f64 * p.y, p.y * (1.0 - 0.05 * frame as f64)));
        let whole = merged(&trajectory, 1e-6, 1e-6);
        assert_eq!(whole[0].len(), CHAIN.len());
        for (p, q) in whole[0].iter().zip(CHAIN) {
            assert!(p.distance(Point::new(q[0], q[1])) < 1e-9);
        }
    }

    #[test]
    fn split_that_the_motion_bends_at_stays() {
        let bend = |frame: usize, p: Point| {
            Point::new(p.x, p.y + if p.x > 60.0 { (p.x - 60.0) * 0.2 * frame as f64 } else { 0.0 })
        };
        let kept = merged(&moving(bend), 0.05, 0.1)[0].len();
        assert!(kept > CHAIN.len(), "{kept} points");
        assert!(kept < 4 * CHAIN.len(), "{kept} points: splits away from the bend may go");
    }
}
