//! Moves the landmarks of mouth and jaw.

use super::channel::{Channel, Pose};
use crate::face::{Face, Landmarks};
use crate::opening::Opening;
use crate::point::Point;

// Ranges of motion at full deflection, in mouth widths (own choice within the limits of published sliders).
const WIDEST_GAPE: f64 = 0.52; // between the inner lips
const LEAST_DROP: f64 = 0.25; // of a mouth that rests open
const CHIN_SHARE: f64 = 0.85; // of the lower lip's drop; the lip itself stretches for the rest
const CORNER_SHARE: f64 = 0.3; // of the drop, at the mouth corners
const CORNER_IN_BY_JAW: f64 = 0.06;
const WIDEN: f64 = 0.12;
const NARROW: f64 = 0.08;
const ROUND_IN: f64 = 0.125; // each corner
const ROUND_POUT: f64 = 0.035;
const UPPER_RAISE: f64 = 0.12;
const LOWER_RAISE: f64 = 0.12;
const PRESS_THIN: f64 = 0.02;
const SMILE_UP: f64 = 0.10;
const SMILE_OUT: f64 = 0.07;
const FROWN_IN: f64 = 0.02;
const TONGUE_LIFT: f64 = 0.15;

/// Where colliding lips meet: mostly the lower lip gives way.
pub const CONTACT: f64 = 0.25;

/// Where pressed lips meet: this far from the upper to the lower lip.
const MEETING: f64 = 0.35;

/// Weight of the jaw's drop along the contour 0…16: cosine from the chin, none at the ears.
const CONTOUR: [f64; 17] =
    [0.0, 0.0, 0.05, 0.15, 0.36, 0.61, 0.84, 0.96, 1.0, 0.96, 0.84, 0.61, 0.36, 0.15, 0.05, 0.0, 0.0];

/// Upper outer lip, lower outer lip, and the inner pair (61…63, 67…65) each of their points goes along with.
const LIP_FOLLOWERS: [(usize, usize, usize); 3] = [(50, 58, 0), (51, 57, 1), (52, 56, 2)];

/// Adds the mouth's articulators to `points`, which are the resting landmarks or a pose of them.
pub fn articulate(points: &mut Landmarks, rest: &Landmarks, face: &Face, pose: &Pose) {
    let width = face.mouth_width;
    let centre = rest[48].lerp(rest[54], 0.5);
    let jaw = pose.value(Channel::Jaw);
    let neutral = pose.value(Channel::Neutral);
    let rest_gape = (rest[66] - rest[62]).dot(face.down).max(0.0) / width;
    let drop = (WIDEST_GAPE - rest_gape * (1.0 - neutral)).max(LEAST_DROP) * jaw;
    join_lips(points, neutral, Point::ZERO);
    let smile = pose.value(Channel::Smile);
    let spread = pose.value(Channel::Width);
    let stretch = spread * if spread > 0.0 { WIDEN } else { NARROW }
        - ROUND_IN * pose.value(Channel::Round)
        - CORNER_IN_BY_JAW * jaw
        + smile * if smile > 0.0 { SMILE_OUT } else { FROWN_IN };
    for i in 48..68 {
        let across = ((rest[i] - centre).dot(face.right) / (0.5 * width)).clamp(-1.0, 1.0);
        let (rim, bow) = (across * across, 1.0 - across * across);
        let arch = 1.0 - across.abs().powi(3); // a lower lip hangs in a round arch, not in a point
        let lift = SMILE_UP * smile * rim;
        let lowered = match side(i) {
            Side::Corner => CORNER_SHARE * drop,
            Side::Upper => {
                CORNER_SHARE * drop * rim * rim
                    - UPPER_RAISE * pose.value(Channel::UpperRaise) * bow
                    - ROUND_POUT * pose.value(Channel::Round) * bow
            }
            Side::Lower => {
                drop * (CORNER_SHARE + (1.0 - CORNER_SHARE) * arch)
                    - LOWER_RAISE * pose.value(Channel::LowerRaise) * bow
                    + ROUND_POUT * pose.value(Channel::Round) * bow
            }
        };
        points[i] += face.vector(stretch * across * width, (lowered - lift) * width);
    }
    for (point, weight) in points.iter_mut().zip(CONTOUR) {
        *point += face.down * (weight * CHIN_SHARE * drop * width);
    }
    for point in &mut points[31..36] {
        *point += face.down * (-0.15 * UPPER_RAISE * pose.value(Channel::UpperRaise) * width);
    }
    let press = pose.value(Channel::Press);
    join_lips(points, press, face.down * (PRESS_THIN * press * width));
}

/// Brings the inner lips together by `share` and the outer lips with them, each lip thinner by `thin`.
fn join_lips(points: &mut Landmarks, share: f64, thin: Point) {
    if share <= 0.0 {
        return;
    }
    let mut shifts = [(Point::ZERO, Point::ZERO); 3];
    for (shift, (upper, lower)) in shifts.iter_mut().zip(Opening::Mouth.pairs()) {
        let meeting = points[upper].lerp(points[lower], MEETING);
        *shift = ((meeting - points[upper]) * share, (meeting - points[lower]) * share);
        points[upper] = points[upper].lerp(meeting, share);
        points[lower] = points[lower].lerp(meeting, share);
    }
    for (upper, lower, pair) in LIP_FOLLOWERS {
        points[upper] += shifts[pair].0 * 0.85 + thin;
        points[lower] += shifts[pair].1 * 0.85 - thin;
    }
    for (upper, lower, pair) in [(49, 59, 0), (53, 55, 2)] {
        points[upper] += shifts[pair].0 * 0.7;
        points[lower] += shifts[pair].1 * 0.7;
    }
}

enum Side {
    Corner,
    Upper,
    Lower,
}

/// Lip on which a landmark 48…67 lies.
const fn side(landmark: usize) -> Side {
    match landmark {
        48 | 54 | 60 | 64 => Side::Corner,
        49..=53 | 61..=63 => Side::Upper,
        _ => Side::Lower,
    }
}

/// Keeps contours from passing through each other: crossed pairs of `opening` meet at `meeting` of the way from the upper
/// to the lower point.
pub fn keep_contact(points: &mut Landmarks, rest: &Landmarks, face: &Face, opening: Opening, meeting: f64) {
    for (upper, lower) in opening.pairs() {
        let gap = (points[lower] - points[upper]).dot(face.down);
        let rest_gap = (rest[lower] - rest[upper]).dot(face.down);
        if gap < 0.0 && rest_gap >= 0.0 {
            let contact = points[upper].lerp(points[lower], meeting);
            points[upper] = contact;
            points[lower] = contact;
        }
    }
}

/// Displacement of the tongue's tip beyond the jaw's.
#[must_use]
pub fn tongue(face: &Face, pose: &Pose) -> Point {
    face.down * (-TONGUE_LIFT * pose.value(Channel::TongueTip) * face.mouth_width)
}
