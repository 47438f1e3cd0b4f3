//! Rigid motion of the head or of one path: a shift and a turn a frame, exactly as browsers interpolate what is written.

use super::keyframes::{Trajectory, keyframes, largest_move};
use super::path_data::whole;
use crate::point::Point;

/// Share of the tolerance that the written motion may miss the fitted one by. What it misses is not lost: outlines
/// are written relative to the written motion.
const FIT_SHARE: f64 = 0.25;

/// Hundredths of a degree: at 500 px from the pivot a step is 0.09 px.
const ANGLE_STEPS: f64 = 100.0;

/// A group's motion: turn about the group's origin, then shift of the origin.
#[derive(Clone, Debug)]
pub struct RigidMotion {
    /// Rest place of the origin, in steps.
    pub pivot: [i64; 2],
    pub keys: Vec<usize>,
    /// Place of the origin at each keyframe, in steps.
    pub shifts: Vec<[i64; 2]>,
    /// Hundredths of a degree at each keyframe, clockwise on screen.
    pub angles: Vec<i64>,
}

/// Written motion in one frame: x ↦ `turn`·x + `place`.
#[derive(Clone, Copy, Debug)]
pub struct Placement {
    turn: Point,
    place: Point,
}

impl Placement {
    /// Coordinates in the group of a point of the picture.
    #[must_use]
    pub fn to_local(self, point: Point) -> Point {
        (point - self.place).complex_div(self.turn)
    }
}

/// Shift and turn that fit the points best in every frame; None when they move less than `still`.
#[must_use]
pub fn rigid_motion(points: &Trajectory, step: f64, tolerance: f64, still: f64) -> Option<RigidMotion> {
    let rest = points.first().filter(|points| points.len() >= 2)?;
    if largest_move(points) < still {
        return None;
    }
    let pivot = mean(rest);
    let radius = rest.iter().map(|p| p.distance(pivot)).fold(0.0, f64::max);
    let fits: Vec<(Point, f64)> = points.iter().map(|points| fit(rest, points)).collect();
    // a turn counts by how far it moves the outermost point
    let curve = fits.iter().map(|(place, angle)| vec![*place, Point::new(angle * radius, 0.0)]).collect();
    let keys = keyframes(&curve, FIT_SHARE * tolerance);
    Some(RigidMotion {
        pivot: [whole(pivot.x / step), whole(pivot.y / step)],
        shifts: keys.iter().map(|&k| [whole(fits[k].0.x / step), whole(fits[k].0.y / step)]).collect(),
        angles: keys.iter().map(|&k| whole(fits[k].1.to_degrees() * ANGLE_STEPS)).collect(),
        keys,
    })
}

impl RigidMotion {
    /// Placement in `frame`, in portrait pixels, between the keyframes as SMIL interpolates: shift and angle by themselves.
    #[must_use]
    pub fn placement(&self, frame: usize, step: f64) -> Placement {
        let after = self.keys.partition_point(|&key| key < frame).max(1).min(self.keys.len() - 1);
        let (from, to) = (after.saturating_sub(1), after);
        let span = (self.keys[to] - self.keys[from]).max(1) as f64;
        let share = (frame - self.keys[from]) as f64 / span;
        let place = |i: usize| Point::new(self.shifts[i][0] as f64, self.shifts[i][1] as f64) * step;
        let angle = |i: usize| (self.angles[i] as f64 / ANGLE_STEPS).to_radians();
        let turned = angle(from) + (angle(to) - angle(from)) * share;
        Placement { turn: Point::new(turned.cos(), turned.sin()), place: place(from).lerp(place(to), share) }
    }
}

/// Place of the centroid and angle (radians) of the rigid motion from `rest` to `points` with the least squares
/// (Procrustes, in complex numbers: the angle of Σ conj(p)·q about the centroids).
fn fit(rest: &[Point], points: &[Point]) -> (Point, f64) {
    let (p0, q0) = (mean(rest), mean(points));
    let product = rest.iter().zip(points).fold(Point::ZERO, |sum, (p, q)| {
        let p = *p - p0;
        sum + (*q - q0).complex_mul(Point::new(p.x, -p.y))
    });
    (q0, product.y.atan2(product.x))
}

fn mean(points: &[Point]) -> Point {
    points.iter().fold(Point::ZERO, |sum, p| sum + *p) * (1.0 / points.len() as f64)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may panic")]
    use super::*;

    #[test]
    fn rigid_motion_leaves_its_points_at_rest() {
        let rest = [Point::new(40.0, 50.0), Point::new(160.0, 52.0), Point::new(100.0, 90.0)];
        let head: Trajectory = (0..40)
            .map(|frame| {
                let angle = (f64::from(frame) * 0.15).sin() * 0.2;
                let turn = Point::new(angle.cos(), angle.sin());
                rest.iter()
                    .map(|p| (*p - rest[0]).complex_mul(turn) + rest[0] + Point::new(angle * 30.0, 4.0))
                    .collect()
            })
            .collect();
        let motion = rigid_motion(&head, 0.125, 0.5, 0.35).unwrap();
        assert!(motion.keys.len() < 40);
        let start = motion.placement(0, 0.125);
        for (frame, points) in head.iter().enumerate() {
            let placement = motion.placement(frame, 0.125);
            for (p, q) in points.iter().zip(&head[0]) {
                assert!(placement.to_local(*p).distance(start.to_local(*q)) < 0.5);
            }
        }
    }

    #[test]
    fn resting_points_have_no_motion() {
        let head = vec![vec![Point::new(1.0, 2.0), Point::new(3.0, 4.0)]; 5];
        assert!(rigid_motion(&head, 0.125, 0.5, 0.35).is_none());
    }
}
