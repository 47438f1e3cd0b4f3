//! Moves lids, brows and irises.

use super::channel::{Channel, Pose};
use crate::face::{Face, Iris, Landmarks};
use crate::opening::Opening;
use crate::point::Point;

/// Where the lids of a narrow eye meet: this far from the upper to the lower lid, so the lower one rises by the rest.
const LID_MEETING: f64 = 0.9;
/// The same of an eye as high as wide, as in drawings, whose closed line would otherwise hang in a bag.
const ROUND_LID_MEETING: f64 = 0.64;
/// Height over width up to which an eye counts as narrow.
const NARROW: f64 = 0.5;
/// Part of the eye's height by which the upper lid follows the gaze down, and up.
const LID_FOLLOWS_DOWN: f64 = 0.2;
const LID_FOLLOWS_UP: f64 = 0.1;
/// Part of the eye's height by which a smile lifts the lower lid.
const SMILE_LIFTS_LID: f64 = 0.08;

// Brow motion in outer-eye distances.
const BROW_UP: f64 = 0.09;
const BROW_DOWN: f64 = 0.05;
const BROW_IN: f64 = 0.02;
const BROW_DIP: f64 = 0.025; // with a full blink
/// Share of the room between brow and lid that a brow may sink by.
const BROW_ROOM: f64 = 0.15;

/// Adds lids and brows to `points`, which are the resting landmarks or a pose of them.
pub fn articulate(points: &mut Landmarks, rest: &Landmarks, face: &Face, pose: &Pose) {
    let eyes = [
        (Opening::LeftEye, Channel::BlinkLeft, Channel::BrowLeft, 17..22, 1.0),
        (Opening::RightEye, Channel::BlinkRight, Channel::BrowRight, 22..27, -1.0),
    ];
    for (opening, blink, brow, brow_points, inwards) in eyes {
        let (blink, brow) = (pose.value(blink), pose.value(brow));
        move_lids(points, rest, opening, blink, pose);
        let middle = brow_points.start + 2;
        let room = (rest[opening.upper()[1]] - rest[middle]).dot(face.down) / face.eye_distance;
        let sink = (BROW_DOWN * (-brow).max(0.0) + BROW_DIP * blink.max(0.0)).min(BROW_ROOM * room.max(0.0));
        let rise = BROW_UP * brow.max(0.0) - sink;
        let inward = inwards * BROW_IN * (-brow).max(0.0);
        let shift = face.vector(inward * face.eye_distance, -rise * face.eye_distance);
        for point in &mut points[brow_points] {
            *point += shift;
        }
    }
}

/// Where the lids of an eye meet, as a share of the way from the upper to the lower one.
#[must_use]
pub fn lid_meeting(rest: &Landmarks, opening: Opening) -> f64 {
    let ends = (opening.upper()[0], opening.upper()[3]);
    let width = rest[ends.0].distance(rest[ends.1]);
    let height = opening.pairs().map(|(upper, lower)| rest[upper].distance(rest[lower])).fold(0.0, f64::max);
    let roundness = ((height / width.max(f64::MIN_POSITIVE) - NARROW) / (1.0 - NARROW)).clamp(0.0, 1.0);
    LID_MEETING + (ROUND_LID_MEETING - LID_MEETING) * roundness
}

fn move_lids(points: &mut Landmarks, rest: &Landmarks, opening: Opening, blink: f64, pose: &Pose) {
    let gaze = pose.value(Channel::GazeY);
    let follow = gaze * if gaze > 0.0 { LID_FOLLOWS_DOWN } else { LID_FOLLOWS_UP };
    let lift = SMILE_LIFTS_LID * pose.value(Channel::Smile).max(0.0);
    let meeting = lid_meeting(rest, opening);
    for (upper, lower) in opening.pairs() {
        let open = rest[lower] - rest[upper];
        let (upper_now, lower_now) = (open * follow, open * -lift);
        let closed = open * meeting;
        let toward = blink.max(0.0);
        points[upper] += upper_now.lerp(closed, toward) + closed * blink.min(0.0);
        points[lower] += lower_now.lerp(closed - open, toward) + (closed - open) * blink.min(0.0);
        if blink == 1.0 {
            // The same number on both lids, so that the opening's area is exactly zero.
            points[lower] = points[upper];
        }
    }
}

/// Displacement of each iris by the gaze: as far as the iris stays mostly inside its eye.
#[must_use]
pub fn gaze(rest: &Landmarks, irises: &[Iris; 2], face: &Face, pose: &Pose) -> [Point; 2] {
    let mut shifts = [Point::ZERO; 2];
    for (shift, (iris, first)) in shifts.iter_mut().zip(irises.iter().zip([36, 42])) {
        let width = rest[first].distance(rest[first + 3]);
        let middle_gap = |a: usize, b: usize| rest[first + a].distance(rest[first + b]);
        let height = middle_gap(1, 5).midpoint(middle_gap(2, 4));
        let across = (0.5 * width - 0.9 * iris.radius).clamp(0.1 * width, 0.26 * width);
        let along = (0.3 * height).clamp(0.05 * width, 0.2 * width);
        *shift = face.vector(across * pose.value(Channel::GazeX), along * pose.value(Channel::GazeY));
    }
    shifts
}
