//! Chooses the few frames between which straight lines stay within a tolerance of all others.

use crate::point::Point;

/// Points over time: `points[frame][i]`, every frame with the same number.
pub type Trajectory = Vec<Vec<Point>>;

/// Frames to keep, ascending, first and last included: Ramer-Douglas-Peucker over time, where the distance is that of the
/// point farthest from its interpolated place.
#[must_use]
pub fn keyframes(trajectory: &Trajectory, tolerance: f64) -> Vec<usize> {
    let last = trajectory.len().saturating_sub(1);
    let mut kept = vec![0];
    let mut spans = vec![(0, last)];
    while let Some((from, to)) = spans.pop() {
        match worst_frame(trajectory, from, to) {
            Some((frame, error)) if error > tolerance => spans.extend([(frame, to), (from, frame)]),
            _ if to > from => kept.push(to),
            _ => {}
        }
    }
    kept
}

/// The frame strictly between `from` and `to` that their interpolation misses most, and by how much.
fn worst_frame(trajectory: &Trajectory, from: usize, to: usize) -> Option<(usize, f64)> {
    (from + 1..to)
        .map(|frame| {
            let share = (frame - from) as f64 / (to - from) as f64;
            (frame, lerp_error(trajectory, from, to, share, frame))
        })
        .max_by(|a, b| a.1.total_cmp(&b.1))
}

fn lerp_error(trajectory: &Trajectory, from: usize, to: usize, share: f64, frame: usize) -> f64 {
    let (start, end, wanted) = (&trajectory[from], &trajectory[to], &trajectory[frame]);
    let squared = start.iter().zip(end).zip(wanted).map(|((a, b), p)| {
        let miss = a.lerp(*b, share) - *p;
        miss.dot(miss)
    });
    squared.fold(0.0, f64::max).sqrt()
}

/// Largest distance of any point from its place in the first frame.
#[must_use]
pub fn largest_move(trajectory: &Trajectory) -> f64 {
    let Some((first, rest)) = trajectory.split_first() else {
        return 0.0;
    };
    let distances = rest.iter().flat_map(|points| points.iter().zip(first).map(|(p, q)| p.distance(*q)));
    distances.fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may panic")]
    use super::*;
    use proptest::prelude::*;

    fn one_point(ys: &[f64]) -> Trajectory {
        ys.iter().map(|y| vec![Point::new(0.0, *y)]).collect()
    }

    #[test]
    fn straight_motion_needs_its_ends() {
        assert_eq!(keyframes(&one_point(&[0.0, 1.0, 2.0, 3.0]), 1e-9), vec![0, 3]);
    }

    #[test]
    fn corner_is_kept() {
        assert_eq!(keyframes(&one_point(&[0.0, 0.0, 5.0, 5.0, 5.0]), 0.1), vec![0, 1, 2, 4]);
    }

    #[test]
    fn single_frame_is_its_own_keyframe() {
        assert_eq!(keyframes(&one_point(&[1.0]), 0.1), vec![0]);
    }

    proptest! {
        #[test]
        fn interpolation_stays_within_tolerance(ys in prop::collection::vec(-9.0..9.0f64, 2..60), tolerance in 0.01..3.0f64) {
            let kept = keyframes(&one_point(&ys), tolerance);
            prop_assert_eq!((kept[0], *kept.last().unwrap()), (0, ys.len() - 1));
            for span in kept.windows(2) {
                for frame in span[0]..span[1] {
                    let share = (frame - span[0]) as f64 / (span[1] - span[0]) as f64;
                    let y = ys[span[0]] + (ys[span[1]] - ys[span[0]]) * share;
                    prop_assert!((y - ys[frame]).abs() <= tolerance + 1e-12);
                }
            }
        }
    }
}
