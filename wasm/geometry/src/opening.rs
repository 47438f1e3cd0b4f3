//! Turns landmarks into the closed cubic outlines of the eye and mouth openings.
//!
//! An outline is *linear in the landmarks* (a Catmull-Rom spline with constant weights, sharp at its two corners), so that
//! one function serves as clip path, as the optimiser's mask and as animated `d`: interpolating landmarks and
//! interpolating outlines are the same thing. Where upper and lower contour coincide, the outline runs back over itself
//! and its area is exactly zero.

use crate::cubic::{eval, segment};
use crate::point::Point;

/// Number of iBUG landmarks.
pub const N_LANDMARKS: usize = 68;

/// A mouth whose gap |62−66| is below this share of the mouth width |48−54| rests closed.
pub const CLOSED_MOUTH: f64 = 0.04;

/// An eye whose mean lid gap is below this share of its width rests closed.
pub const CLOSED_EYE: f64 = 0.06;

/// One of the three openings; eyes are named as seen in the image.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Opening {
    LeftEye,
    RightEye,
    Mouth,
}

impl Opening {
    pub const ALL: [Self; 3] = [Self::LeftEye, Self::RightEye, Self::Mouth];

    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::LeftEye => "left_eye",
            Self::RightEye => "right_eye",
            Self::Mouth => "mouth",
        }
    }

    /// Landmarks along the upper contour, corner to corner, image-left to image-right.
    #[must_use]
    pub const fn upper(self) -> &'static [usize] {
        match self {
            Self::LeftEye => &[36, 37, 38, 39],
            Self::RightEye => &[42, 43, 44, 45],
            Self::Mouth => &[60, 61, 62, 63, 64],
        }
    }

    /// Landmarks along the lower contour, each below its neighbour of `upper`; the corners are shared.
    #[must_use]
    pub const fn lower(self) -> &'static [usize] {
        match self {
            Self::LeftEye => &[36, 41, 40, 39],
            Self::RightEye => &[42, 47, 46, 45],
            Self::Mouth => &[60, 67, 66, 65, 64],
        }
    }

    /// Upper and lower landmarks that meet when the opening closes.
    pub fn pairs(self) -> impl Iterator<Item = (usize, usize)> {
        let inner = 1..self.upper().len() - 1;
        inner.map(move |i| (self.upper()[i], self.lower()[i]))
    }

    /// Landmarks once around: along the upper contour, back along the lower one.
    #[must_use]
    pub fn ring(self) -> Vec<usize> {
        let back = self.lower().iter().rev().skip(1).take(self.lower().len() - 2);
        self.upper().iter().chain(back).copied().collect()
    }

    /// Whether the opening counts as closed in this face, so that it has no interior at rest.
    #[must_use]
    pub fn is_closed(self, landmarks: &[Point; N_LANDMARKS]) -> bool {
        match self {
            Self::Mouth => {
                let width = landmarks[48].distance(landmarks[54]);
                landmarks[62].distance(landmarks[66]) < CLOSED_MOUTH * width
            }
            Self::LeftEye | Self::RightEye => {
                let ends = (self.upper()[0], self.upper()[3]);
                let width = landmarks[ends.0].distance(landmarks[ends.1]);
                let gap: f64 = self.pairs().map(|(u, l)| landmarks[u].distance(landmarks[l])).sum();
                gap / 2.0 < CLOSED_EYE * width
            }
        }
    }

    /// Closed chain of cubics around the opening, `anchor, handle, handle` per landmark of `ring`.
    #[must_use]
    pub fn outline(self, landmarks: &[Point]) -> Vec<Point> {
        let ring = self.ring();
        let corner = self.upper().len() - 1;
        let anchors: Vec<Point> = ring.iter().map(|&i| landmarks[i]).collect();
        let n = anchors.len();
        let tangents = sharp_tangents(&anchors, corner);
        (0..n)
            .flat_map(|i| {
                let next = (i + 1) % n;
                let (leaving, _) = tangents[i];
                let (_, arriving) = tangents[next];
                [anchors[i], anchors[i] + leaving * (1.0 / 3.0), anchors[next] - arriving * (1.0 / 3.0)]
            })
            .collect()
    }

    /// The point of the upper edge nearest to `p`, and the landmarks that it is a combination of, with their weights.
    #[must_use]
    pub fn nearest_on_upper_edge(self, p: Point, landmarks: &[Point]) -> (Point, Vec<(usize, f64)>) {
        let outline = self.outline(landmarks);
        let on_edge = |outline: &[Point], (j, t): (usize, f64)| eval(&segment(outline, j), t);
        let distance = |place| on_edge(&outline, place).distance(p);
        let place = (0..self.upper().len() - 1)
            .flat_map(|j| (0..=STEPS).map(move |k| (j, f64::from(k) / f64::from(STEPS))))
            .fold((0, 0.0), |nearest, place| if distance(place) < distance(nearest) { place } else { nearest });
        let share = |landmark: usize| {
            let mut unit = [Point::ZERO; N_LANDMARKS];
            unit[landmark].x = 1.0;
            on_edge(&self.outline(&unit), place).x
        };
        (on_edge(&outline, place), self.ring().into_iter().map(|landmark| (landmark, share(landmark))).collect())
    }
}

/// Places of a segment among which the nearest one is looked for.
const STEPS: u32 = 32;

/// Outline of one opening at rest; `closed` openings have zero area.
#[derive(Clone, Debug)]
pub struct RestOutline {
    pub opening: Opening,
    pub points: Vec<Point>,
    pub closed: bool,
}

/// Outlines of all openings of a resting face, closed ones snapped to their midline.
#[must_use]
pub fn rest_outlines(landmarks: &[Point; N_LANDMARKS]) -> [RestOutline; 3] {
    let rest = snap_closed(landmarks);
    Opening::ALL.map(|opening| RestOutline {
        opening,
        points: opening.outline(&rest),
        closed: opening.is_closed(&rest),
    })
}

/// Landmarks with both contours of every closed opening moved onto their common midline.
#[must_use]
pub fn snap_closed(landmarks: &[Point; N_LANDMARKS]) -> [Point; N_LANDMARKS] {
    let mut rest = *landmarks;
    for opening in Opening::ALL {
        if opening.is_closed(landmarks) {
            for (upper, lower) in opening.pairs() {
                let middle = landmarks[upper].lerp(landmarks[lower], 0.5);
                rest[upper] = middle;
                rest[lower] = middle;
            }
        }
    }
    rest
}

/// (leaving, arriving) tangents of a closed ring: central differences, at the corners 0 and `corner` one-sided ones that
/// make the end's second derivative vanish.
fn sharp_tangents(anchors: &[Point], corner: usize) -> Vec<(Point, Point)> {
    let n = anchors.len();
    let central = |i: usize| (anchors[(i + 1) % n] - anchors[(i + n - 1) % n]) * 0.5;
    (0..n)
        .map(|i| {
            if i != 0 && i != corner {
                return (central(i), central(i));
            }
            let (next, previous) = ((i + 1) % n, (i + n - 1) % n);
            let leaving = ((anchors[next] - anchors[i]) * 3.0 - central(next)) * 0.5;
            let arriving = ((anchors[i] - anchors[previous]) * 3.0 - central(previous)) * 0.5;
            (leaving, arriving)
        })
        .collect()
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a contour without ends fails the test")]
    use super::*;
    use crate::cubic::signed_area;

    fn round_face() -> [Point; N_LANDMARKS] {
        std::array::from_fn(|i| Point::new((i as f64).cos() * 50.0 + i as f64, (i as f64 * 1.7).sin() * 40.0))
    }

    #[test]
    fn outline_is_linear_in_the_landmarks() {
        let (a, b) = (round_face(), round_face().map(|p| Point::new(p.y, p.x * 2.0)));
        let middle: [Point; N_LANDMARKS] = std::array::from_fn(|i| a[i].lerp(b[i], 0.3));
        for opening in Opening::ALL {
            let (from, to) = (opening.outline(&a), opening.outline(&b));
            for (k, p) in opening.outline(&middle).into_iter().enumerate() {
                assert!(p.distance(from[k].lerp(to[k], 0.3)) < 1e-12);
            }
        }
    }

    #[test]
    fn coinciding_contours_enclose_nothing() {
        let mut face = round_face();
        for opening in Opening::ALL {
            for (upper, lower) in opening.pairs() {
                face[lower] = face[upper];
            }
            assert!(signed_area(&opening.outline(&face)).abs() < 1e-9);
        }
    }

    #[test]
    fn a_corner_is_the_nearest_point_of_the_upper_edge_to_itself() {
        let face = round_face();
        for (opening, corner) in
            Opening::ALL.into_iter().flat_map(|o| [(o, o.upper()[0]), (o, *o.upper().last().unwrap())])
        {
            let (foot, shares) = opening.nearest_on_upper_edge(face[corner], &face);
            assert_eq!(foot, face[corner]);
            assert_eq!(shares.iter().filter(|(_, share)| *share != 0.0).collect::<Vec<_>>(), [&(corner, 1.0)]);
        }
    }

    #[test]
    fn closed_mouth_is_snapped_to_its_midline() {
        let mut face = round_face();
        face[48] = Point::new(0.0, 0.0);
        face[54] = Point::new(100.0, 0.0);
        face[62] = Point::new(50.0, 0.0);
        face[66] = Point::new(50.0, 3.9);
        let rest = snap_closed(&face);
        assert_eq!(rest[62], Point::new(50.0, 1.95));
        assert_eq!(rest[62], rest[66]);
        face[66] = Point::new(50.0, 4.1);
        assert_eq!(snap_closed(&face)[66], face[66]);
    }
}
