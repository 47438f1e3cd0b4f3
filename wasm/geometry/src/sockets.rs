//! Finds the lids of a scene: fore paths that lie within the opening of an eye at rest, where the eyeball hides them.
//!
//! The triangles of an opening collapse as the eye closes and would squeeze such a path flat. A lid goes with the eye's
//! socket instead: what the closing lids leave of the eyeball's place, it covers.

use crate::cubic::{eval, segment};
use crate::local::Part;
use crate::point::Point;

/// Chords by which a cubic is replaced.
const CHORDS: u32 = 8;

/// Polygons of both eye openings at rest.
#[derive(Clone, Debug)]
pub struct Sockets([(Part, Vec<Point>); 2]);

impl Sockets {
    #[must_use]
    pub fn of(rest: &[Point]) -> Self {
        Self([Part::LeftEye, Part::RightEye].map(|eye| (eye, polygon(&eye.opening().outline(rest)))))
    }

    /// The eye that a fore path, a closed chain of cubics, is a lid of.
    #[must_use]
    pub fn eye_of_lid(&self, chain: &[Point]) -> Option<Part> {
        let (eye, opening) = self.0.iter().find(|(_, opening)| inside(chain[0], opening))?;
        polygon(chain).into_iter().all(|p| inside(p, opening)).then_some(*eye)
    }
}

/// Points along a closed chain of cubics.
fn polygon(outline: &[Point]) -> Vec<Point> {
    let steps = (0..outline.len() / 3).flat_map(|j| (0..CHORDS).map(move |k| (j, f64::from(k) / f64::from(CHORDS))));
    steps.map(|(j, t)| eval(&segment(outline, j), t)).collect()
}

/// Whether a ray from `p` to the right crosses the polygon an odd number of times.
fn inside(p: Point, polygon: &[Point]) -> bool {
    let sides = polygon.iter().zip(polygon.iter().cycle().skip(1));
    let crossed =
        |(a, b): &(&Point, &Point)| (a.y > p.y) != (b.y > p.y) && p.x < a.lerp(**b, (p.y - a.y) / (b.y - a.y)).x;
    sides.filter(crossed).count() % 2 == 1
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_lies_wholly_in_an_eye_is_its_lid() {
        let mut rest = vec![Point::ZERO; 68];
        for (eye, left) in [(36, 0.0), (42, 100.0)] {
            let ring = [(0., 10.), (10., 0.), (20., 0.), (30., 10.), (20., 20.), (10., 20.)];
            for (corner, (x, y)) in ring.into_iter().enumerate() {
                rest[eye + corner] = Point::new(left + x, y);
            }
        }
        let sockets = Sockets::of(&rest);
        let diamond = |x: f64, radius: f64| {
            let corners = [(-1., 0.), (0., -1.), (1., 0.), (0., 1.)];
            let corners = corners.map(|(dx, dy)| Point::new(x + radius * dx, 10.0 + radius * dy));
            corners.map(|corner| [corner; 3]).concat()
        };
        assert_eq!(sockets.eye_of_lid(&diamond(15.0, 8.0)), Some(Part::LeftEye));
        assert_eq!(sockets.eye_of_lid(&diamond(115.0, 8.0)), Some(Part::RightEye));
        assert_eq!(sockets.eye_of_lid(&diamond(15.0, 13.0)), None);
        assert_eq!(sockets.eye_of_lid(&diamond(65.0, 8.0)), None);
    }
}
