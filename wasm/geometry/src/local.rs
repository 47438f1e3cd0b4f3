//! Bindings of the local layer: eyes follow their sockets, teeth and tongue their bones, the cavity its lips.
//!
//! All are linear in the vertices. A similarity through two vertices is linear too when points are read as complex
//! numbers: with w = (z − c0) / (c1 − c0), z' = (1 − w) c0' + w c1'.

use crate::binding::Influence;
use crate::error::RigError;
use crate::mesh::vertices::{IRIS, JAW, SKULL, TONGUE};
use crate::opening::Opening;
use crate::point::Point;

/// What a local path depicts; eyes are named as seen in the image. The discriminant is the number on the wire.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    LeftEye,
    RightEye,
    LeftIris,
    RightIris,
    MouthCavity,
    MouthLower,
    Tongue,
    MouthUpper,
}

impl Part {
    pub const ALL: [Self; 8] = [
        Self::LeftEye,
        Self::RightEye,
        Self::LeftIris,
        Self::RightIris,
        Self::MouthCavity,
        Self::MouthLower,
        Self::Tongue,
        Self::MouthUpper,
    ];

    /// Eyeballs, image-left first.
    pub const EYES: [Self; 2] = [Self::LeftEye, Self::RightEye];

    /// # Errors
    /// `RigError::Scene` when no part has this number.
    pub fn from_number(number: u8) -> Result<Self, RigError> {
        Self::ALL
            .get(usize::from(number))
            .copied()
            .ok_or_else(|| RigError::Scene(format!("part {number} does not exist; parts are 0 to 7")))
    }

    /// The opening that clips this part.
    #[must_use]
    pub const fn opening(self) -> Opening {
        match self {
            Self::LeftEye | Self::LeftIris => Opening::LeftEye,
            Self::RightEye | Self::RightIris => Opening::RightEye,
            Self::MouthCavity | Self::MouthLower | Self::Tongue | Self::MouthUpper => Opening::Mouth,
        }
    }
}

/// Influences on a point of `part` at rest.
#[must_use]
pub fn influences(part: Part, p: Point, rest: &[Point], mouth_closed: bool) -> Vec<Influence> {
    match part {
        Part::LeftEye | Part::RightEye => socket(part.opening(), p, rest),
        Part::LeftIris => carried(p, rest, IRIS, [36, 39]),
        Part::RightIris => carried(p, rest, IRIS + 1, [42, 45]),
        Part::MouthUpper => similarity(p, rest, [SKULL, SKULL + 1]),
        Part::MouthLower => similarity(p, rest, [JAW, JAW + 1]),
        Part::Tongue => tongue(p, rest),
        Part::MouthCavity if mouth_closed => mean_value(p, rest, &OUTER_LIPS),
        Part::MouthCavity => mean_value(p, rest, &Opening::Mouth.ring()),
    }
}

const OUTER_LIPS: [usize; 12] = [48, 49, 50, 51, 52, 53, 54, 55, 56, 57, 58, 59];

/// Goes with the corners of an opening.
#[must_use]
pub fn socket(opening: Opening, p: Point, rest: &[Point]) -> Vec<Influence> {
    let upper = opening.upper();
    similarity(p, rest, [upper[0], upper[upper.len() - 1]])
}

/// The similarity that takes two vertices where they go.
fn similarity(p: Point, rest: &[Point], corners: [usize; 2]) -> Vec<Influence> {
    carried(p, rest, corners[0], corners)
}

/// Goes where `centre` goes, turned and scaled as the similarity of the two corners is; two that coincide turn nothing.
fn carried(p: Point, rest: &[Point], centre: usize, [c0, c1]: [usize; 2]) -> Vec<Influence> {
    let across = rest[c1] - rest[c0];
    let w = if across == Point::ZERO { Point::ZERO } else { (p - rest[centre]).complex_div(across) };
    vec![Influence::real(centre, 1.0), Influence { vertex: c0, weight: -w }, Influence { vertex: c1, weight: w }]
}

/// The jaw's similarity, plus what the tip does beyond it, fading with the distance from the tip.
fn tongue(p: Point, rest: &[Point]) -> Vec<Influence> {
    let reach = 0.3 * rest[JAW].distance(rest[JAW + 1]);
    let share = 1.0 / (1.0 + (p.distance(rest[TONGUE]) / reach).powi(2));
    let mut influences = similarity(p, rest, [JAW, JAW + 1]);
    influences.push(Influence::real(TONGUE, share));
    for tip in similarity(rest[TONGUE], rest, [JAW, JAW + 1]) {
        influences.push(Influence { vertex: tip.vertex, weight: tip.weight * -share });
    }
    influences
}

/// Mean value coordinates (Hormann and Floater 2006): the cage's boundary is reproduced, its interior follows smoothly.
fn mean_value(p: Point, rest: &[Point], cage: &[usize]) -> Vec<Influence> {
    let n = cage.len();
    let spokes: Vec<Point> = cage.iter().map(|&vertex| rest[vertex] - p).collect();
    let radii: Vec<f64> = spokes.iter().map(|spoke| spoke.norm()).collect();
    let tiny = 1e-9 * radii.iter().fold(0.0, |a: f64, &b| a.max(b));
    if let Some(i) = radii.iter().position(|&radius| radius <= tiny) {
        return vec![Influence::real(cage[i], 1.0)];
    }
    // tan(α/2) of the angle under which each side is seen from p.
    let mut half_tangents = Vec::with_capacity(n);
    for i in 0..n {
        let next = (i + 1) % n;
        let (cross, dot) = (spokes[i].cross(spokes[next]), spokes[i].dot(spokes[next]));
        if cross.abs() <= tiny * radii[i].max(radii[next]) && dot < 0.0 {
            let s = radii[i] / (radii[i] + radii[next]);
            return vec![Influence::real(cage[i], 1.0 - s), Influence::real(cage[next], s)];
        }
        half_tangents.push(cross / (radii[i] * radii[next] + dot));
    }
    let weights: Vec<f64> = (0..n).map(|i| (half_tangents[(i + n - 1) % n] + half_tangents[i]) / radii[i]).collect();
    let total: f64 = weights.iter().sum();
    cage.iter().zip(weights).map(|(&vertex, weight)| Influence::real(vertex, weight / total)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn moved(p: Point, influences: &[Influence], rest: &[Point], now: &[Point]) -> Point {
        influences.iter().fold(p, |sum, i| sum + (now[i.vertex] - rest[i.vertex]).complex_mul(i.weight))
    }

    #[test]
    fn similarity_turns_and_scales_about_its_vertices() {
        let rest = [Point::new(0.0, 0.0), Point::new(2.0, 0.0)];
        let now = [Point::new(1.0, 1.0), Point::new(1.0, 5.0)]; // doubled, turned by 90°, shifted by (1, 1)
        let p = Point::new(1.0, 1.0);
        let there = moved(p, &similarity(p, &rest, [0, 1]), &rest, &now);
        assert!(there.distance(Point::new(-1.0, 3.0)) < 1e-12);
    }

    proptest! {
        #[test]
        fn mean_value_weights_reproduce_the_point(x in -1.0..5.0, y in -1.0..4.0) {
            let rest = [(0.0, 1.0), (1.0, 0.0), (3.0, 0.2), (4.0, 1.0), (3.0, 2.4), (1.0, 2.0)].map(|(x, y)| Point::new(x, y));
            let p = Point::new(x, y);
            let influences = mean_value(p, &rest, &[0, 1, 2, 3, 4, 5]);
            let sum: f64 = influences.iter().map(|i| i.weight.x).sum();
            let there = influences.iter().fold(Point::ZERO, |sum, i| sum + rest[i.vertex] * i.weight.x);
            prop_assert!((sum - 1.0).abs() < 1e-9);
            prop_assert!(there.distance(p) < 1e-6, "{there:?}");
        }
    }
}
