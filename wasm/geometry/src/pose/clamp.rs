//! Keeps a motion from turning a triangle over.

use crate::mesh::Mesh;
use crate::point::Point;

/// Share of the way to the first flip that is used.
const SAFE: f64 = 0.95;

/// How much of a motion was kept, and the triangles that limit it (none when `scale` is 1).
#[derive(Clone, Debug, PartialEq)]
pub struct Limit {
    pub scale: f64,
    pub triangles: Vec<usize>,
}

impl Limit {
    pub const NONE: Self = Self { scale: 1.0, triangles: Vec::new() };

    /// The stricter of two limits, with the triangles of both.
    #[must_use]
    pub fn and(mut self, other: Self) -> Self {
        self.scale = self.scale.min(other.scale);
        self.triangles.extend(other.triangles);
        self.triangles.sort_unstable();
        self.triangles.dedup();
        self
    }
}

/// Positions on the way from `from` to `to`, at the end of it unless a triangle turns over before.
///
/// A triangle's area along the way is a quadratic in λ, ½(e1 + λd1)×(e2 + λd2), so its first flip has a closed form.
/// Triangles inside an opening may collapse: the local layer covers them.
#[must_use]
pub fn clamp_motion(mesh: &Mesh, from: &[Point], to: &[Point]) -> (Vec<Point>, Limit) {
    let flips: Vec<(usize, f64)> = mesh
        .triangles
        .iter()
        .enumerate()
        .filter(|(_, triangle)| triangle.interior.is_none())
        .filter_map(|(index, triangle)| first_flip(triangle.vertices, from, to).map(|lambda| (index, lambda)))
        .collect();
    let first = flips.iter().map(|&(_, lambda)| lambda).fold(f64::INFINITY, f64::min);
    let scale = SAFE * first;
    if scale >= 1.0 {
        return (to.to_vec(), Limit::NONE);
    }
    let positions = from.iter().zip(to).map(|(&a, &b)| a.lerp(b, scale)).collect();
    let near = first + (1.0 - SAFE) * first.max(0.1);
    let triangles = flips.into_iter().filter(|&(_, lambda)| lambda <= near).map(|(index, _)| index).collect();
    (positions, Limit { scale, triangles })
}

/// Smallest λ in (0, 1/SAFE] at which the triangle has lost all but a trace of its area; 0 when it starts so.
fn first_flip([a, b, c]: [usize; 3], from: &[Point], to: &[Point]) -> Option<f64> {
    let (e1, e2) = (from[b] - from[a], from[c] - from[a]);
    let (d1, d2) = (to[b] - to[a] - e1, to[c] - to[a] - e2);
    if d1 == Point::ZERO && d2 == Point::ZERO {
        return None;
    }
    let area = e1.cross(e2);
    let (q2, q1) = (d1.cross(d2), e1.cross(d2) + d1.cross(e2));
    let root = smallest_positive_root(q2, q1, area)?;
    (root <= 1.0 / SAFE).then_some(root)
}

/// Smallest root >= 0 of q2 λ² + q1 λ + q0, q0 >= 0, where the value turns negative.
fn smallest_positive_root(q2: f64, q1: f64, q0: f64) -> Option<f64> {
    let discriminant = q1 * q1 - 4.0 * q2 * q0;
    if discriminant < 0.0 {
        return None;
    }
    let q = -0.5 * (q1 + discriminant.sqrt().copysign(q1));
    let roots = [q / q2, q0 / q];
    roots.into_iter().filter(|root| root.is_finite() && *root >= 0.0).min_by(f64::total_cmp)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Triangle;
    use proptest::prelude::*;

    fn one_triangle(rest: Vec<Point>) -> Mesh {
        Mesh {
            rest,
            triangles: vec![Triangle { vertices: [0, 1, 2], interior: None }],
            edges: vec![],
            partners: vec![],
        }
    }

    #[test]
    fn motion_across_an_edge_stops_at_95_percent_of_the_way_to_it() {
        let rest = vec![Point::new(0.0, 0.0), Point::new(1.0, 0.0), Point::new(0.5, 1.0)];
        let mut to = rest.clone();
        to[2].y = -1.0; // reaches the edge at λ = ½
        let (positions, limit) = clamp_motion(&one_triangle(rest.clone()), &rest, &to);
        assert!((limit.scale - 0.475).abs() < 1e-12);
        assert!((positions[2].y - 0.05).abs() < 1e-12);
        assert_eq!(limit.triangles, [0]);
    }

    proptest! {
        #[test]
        fn clamped_triangles_keep_their_orientation(moves in prop::array::uniform6(-3.0..3.0f64)) {
            let rest = vec![Point::new(0.0, 0.0), Point::new(1.0, 0.0), Point::new(0.3, 1.0)];
            let to: Vec<Point> = rest.iter().enumerate().map(|(i, &p)| p + Point::new(moves[2 * i], moves[2 * i + 1])).collect();
            let mesh = one_triangle(rest.clone());
            let (_, limit) = clamp_motion(&mesh, &rest, &to);
            for step in 0..=50 {
                let at: Vec<Point> = rest.iter().zip(&to).map(|(&a, &b)| a.lerp(b, limit.scale * f64::from(step) / 50.0)).collect();
                prop_assert!(mesh.double_area(0, &at) > 0.0);
            }
        }
    }
}
