//! Binds points to vertices: a bound point moves by a fixed linear combination of its vertices' displacements.

use crate::point::Point;

/// Weights below this move nothing that could be seen.
const NEGLIGIBLE: f64 = 1e-12;

/// One vertex's share in a point; `weight` is a complex number, real for affine maps, with an angle for similarities.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Influence {
    pub vertex: usize,
    pub weight: Point,
}

impl Influence {
    #[must_use]
    pub const fn real(vertex: usize, weight: f64) -> Self {
        Self { vertex, weight: Point::new(weight, 0.0) }
    }
}

/// Influences of a list of points. Points without any never move.
///
/// Displacements, not positions, are combined: a rig at rest returns its rest points bit for bit.
#[derive(Clone, Debug)]
pub struct Bindings {
    /// `starts[i]..starts[i + 1]` are the influences of point i.
    starts: Vec<usize>,
    influences: Vec<Influence>,
}

impl Default for Bindings {
    fn default() -> Self {
        Self { starts: vec![0], influences: Vec::new() }
    }
}

impl Bindings {
    /// Binds the next point.
    pub fn push(&mut self, influences: &[Influence]) {
        let seen = influences.iter().filter(|influence| influence.weight.norm() > NEGLIGIBLE);
        self.influences.extend(seen.copied());
        self.starts.push(self.influences.len());
    }

    #[must_use]
    pub fn of(&self, point: usize) -> &[Influence] {
        &self.influences[self.starts[point]..self.starts[point + 1]]
    }

    /// Displacement of a point whose vertices are displaced by `displacements`.
    #[must_use]
    pub fn displacement(&self, point: usize, displacements: &[Point]) -> Point {
        self.of(point)
            .iter()
            .fold(Point::ZERO, |sum, influence| sum + displacements[influence.vertex].complex_mul(influence.weight))
    }
}
