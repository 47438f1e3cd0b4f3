//! Finds the covers of a scene: fore paths that lie within the opening of an eye at rest, where the eyeball hides them.
//!
//! The triangles of an opening collapse as the eye closes and would squeeze such a path flat. A lid goes with the eye's
//! socket instead: what the closing lids leave of the eyeball's place, it covers. Skin, fringe and glasses around an eye
//! with such a lid need not move to close it, and rest. A lash line, which lies along the upper edge, goes down with the
//! upper lid and comes out from under the eyeball on the way.

use crate::binding::Influence;
use crate::local::{Part, socket};
use crate::opening::Opening;
use crate::point::Point;
use crate::polygon::{area, contains, polygon};

/// Share of the way from the upper to the lower edge in which lash lines lie.
const LASH_STRIP: f64 = 0.2;
/// Share of the upper lid's way that a lash line falls behind: that much of the eye's height is out from under the
/// eyeball when the eye is shut.
const LASH_LAG: f64 = 0.3;

/// Share of an eye's opening that a lid of its own fills; skin that the tracing hid there is in smaller shreds.
const FILLED: f64 = 0.6;

/// A fore path that an eyeball hides at rest.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cover {
    Lid(Part),
    Lash(Part),
}

/// One eye at rest: polygons of its opening, and of the strip along the upper edge of it.
#[derive(Clone, Debug)]
struct Socket {
    eye: Part,
    opening: Vec<Point>,
    strip: Vec<Point>,
}

/// Both eyes at rest.
#[derive(Clone, Debug)]
pub struct Sockets([Socket; 2]);

impl Sockets {
    #[must_use]
    pub fn of(rest: &[Point]) -> Self {
        Self(Part::EYES.map(|eye| {
            let opening = polygon(&eye.opening().outline(rest));
            Socket { eye, strip: upper_strip(&opening), opening }
        }))
    }

    /// What a fore path, a closed chain of cubics, covers.
    #[must_use]
    pub fn cover(&self, chain: &[Point]) -> Option<Cover> {
        let path = polygon(chain);
        let within = |region: &[Point]| path.iter().all(|&p| contains(region, p));
        let Socket { eye, strip, .. } = self.0.iter().find(|socket| within(&socket.opening))?;
        Some(if within(strip) { Cover::Lash(*eye) } else { Cover::Lid(*eye) })
    }

    /// Whether a lid fills its eye, so that nothing else need move to close it.
    #[must_use]
    pub fn is_filled(&self, eye: Part, lid: &[Point]) -> bool {
        self.0.iter().any(|socket| socket.eye == eye && area(&polygon(lid)) > FILLED * area(&socket.opening))
    }
}

impl Cover {
    /// Influences on a point of the path at rest.
    #[must_use]
    pub fn influences(self, p: Point, rest: &[Point]) -> Vec<Influence> {
        match self {
            Self::Lid(eye) => socket(eye.opening(), p, rest),
            Self::Lash(eye) => lash(eye.opening(), p, rest),
        }
    }
}

/// Goes with the socket, and for all but `LASH_LAG` with what the nearest point of the upper edge does beyond that.
fn lash(eye: Opening, p: Point, rest: &[Point]) -> Vec<Influence> {
    let share = 1.0 - LASH_LAG;
    let (foot, edge) = eye.nearest_on_upper_edge(p, rest);
    let mut influences = socket(eye, p, rest);
    influences.extend(edge.into_iter().map(|(landmark, weight)| Influence::real(landmark, share * weight)));
    influences.extend(socket(eye, foot, rest).into_iter().map(|i| Influence { weight: i.weight * -share, ..i }));
    influences
}

/// The part of an opening's polygon along its upper edge: its points run along that first, and back along the lower one.
fn upper_strip(opening: &[Point]) -> Vec<Point> {
    let n = opening.len();
    let upper = &opening[..=n / 2];
    let inner = (0..=n / 2).map(|i| upper[i].lerp(opening[(n - i) % n], LASH_STRIP));
    upper.iter().copied().chain(inner.rev()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_lies_wholly_in_an_eye_covers_it() {
        let sockets = Sockets::of(&eyes());
        assert_eq!(sockets.cover(&diamond(15.0, 10.0, 8.0)), Some(Cover::Lid(Part::LeftEye)));
        assert_eq!(sockets.cover(&diamond(115.0, 10.0, 8.0)), Some(Cover::Lid(Part::RightEye)));
        assert_eq!(sockets.cover(&diamond(15.0, 1.0, 1.0)), Some(Cover::Lash(Part::LeftEye)));
        assert_eq!(sockets.cover(&diamond(15.0, 10.0, 13.0)), None);
        assert_eq!(sockets.cover(&diamond(65.0, 10.0, 8.0)), None);
    }

    #[test]
    fn lash_lags_behind_the_lid_and_turns_with_the_head() {
        let rest = eyes();
        let p = Point::new(15.0, 1.0);
        let influences = Cover::Lash(Part::LeftEye).influences(p, &rest);
        let moved = |now: &[Point]| {
            influences.iter().fold(p, |sum, i| sum + (now[i.vertex] - rest[i.vertex]).complex_mul(i.weight))
        };
        let mut shut = rest.clone();
        for landmark in [37, 38] {
            shut[landmark].y += 8.0;
        }
        // Half-way between two points that sink by 8 the edge sinks by 9: the tangents there carry on to the corners.
        assert!((moved(&shut).y - p.y - 9.0 * (1.0 - LASH_LAG)).abs() < 0.1, "{:?}", moved(&shut));
        let turn = |q: Point| q.complex_mul(Point::new(0.8, 0.6));
        let turned: Vec<Point> = rest.iter().map(|&q| turn(q)).collect();
        assert!(moved(&turned).distance(turn(p)) < 1e-9);
    }

    fn eyes() -> Vec<Point> {
        let mut rest = vec![Point::ZERO; 68];
        for (eye, left) in [(36, 0.0), (42, 100.0)] {
            let ring = [(0., 10.), (10., 0.), (20., 0.), (30., 10.), (20., 20.), (10., 20.)];
            for (corner, (x, y)) in ring.into_iter().enumerate() {
                rest[eye + corner] = Point::new(left + x, y);
            }
        }
        rest
    }

    fn diamond(x: f64, y: f64, radius: f64) -> Vec<Point> {
        let corners = [(-1., 0.), (0., -1.), (1., 0.), (0., 1.)];
        corners.map(|(dx, dy)| [Point::new(x + radius * dx, y + radius * dy); 3]).concat()
    }
}
