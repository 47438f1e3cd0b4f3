//! Repairs kinks: a piecewise affine warp is only C0, so tangents break where a smooth curve passes from one triangle to
//! the next. Both handles of such a joint are turned onto a common direction between them and keep their lengths.
//!
//! A handle turns the more, the more its triangle is strained and the less its neighbour is: two triangles strained alike
//! share the kink, and a piece in a triangle that rests keeps its rest geometry to the last bit. The repair is exact at
//! rest and follows every similarity. It is not linear in the vertices.

use crate::binding::Influence;
use crate::mesh::Mesh;
use crate::point::Point;
use crate::split::{Anchor, SplitPath};

/// A joint that is smooth at rest: the piece that starts at it, and the triangles of the pieces before and after it.
#[derive(Clone, Copy, Debug)]
pub struct Joint {
    pub piece: usize,
    pub triangles: [usize; 2],
}

/// Joints that are smooth at rest and join two triangles across a common edge. Those at a slit are not among them: there the
/// curve is meant to tear.
#[must_use]
pub fn smooth_joints(path: &SplitPath, mesh: &Mesh) -> Vec<Joint> {
    let n = path.anchors.len();
    (0..n)
        .filter_map(|piece| {
            let Anchor::Edge { ends, .. } = path.anchors[piece] else {
                return None;
            };
            let (before, after) = (path.triangles[(piece + n - 1) % n]?, path.triangles[piece]?);
            let beside_edge = |triangle: usize| ends.iter().all(|end| mesh.triangles[triangle].vertices.contains(end));
            (before != after && beside_edge(before) && beside_edge(after))
                .then_some(Joint { piece, triangles: [before, after] })
        })
        .collect()
}

/// How much each triangle of a mesh is strained: |q| of its affine map z ↦ p z + q z̄ + r of complex numbers, which is 0
/// for similarities. q is linear in the displacements of the triangle's vertices.
#[derive(Clone, Debug, Default)]
pub struct Strains {
    influences: Vec<[Influence; 3]>,
}

impl Strains {
    #[must_use]
    pub fn of(mesh: &Mesh) -> Self {
        let influences = mesh.triangles.iter().map(|triangle| {
            let [a, b, c] = triangle.vertices.map(|vertex| mesh.rest[vertex]);
            // From e1' = p e1 + q ē1 and e2' = p e2 + q ē2 for the edges e1, e2 from a.
            let (e1, e2) = (b - a, c - a);
            let share = |weight: Point| weight * (0.5 / e1.cross(e2));
            let weights = [share(e1 - e2), share(e2), share(-e1)];
            std::array::from_fn(|i| Influence { vertex: triangle.vertices[i], weight: weights[i] })
        });
        Self { influences: influences.collect() }
    }

    /// Strain of one triangle; exactly 0 where no vertex is displaced.
    #[must_use]
    pub fn strain(&self, triangle: usize, displacements: &[Point]) -> f64 {
        let shares = self.influences[triangle].iter().map(|i| displacements[i.vertex].complex_mul(i.weight));
        shares.fold(Point::ZERO, |sum, share| sum + share).norm()
    }
}

/// Turns the handles at `joints` of a closed path, warped by `displacements`, onto a common direction.
pub fn repair(points: &mut [Point], joints: &[Joint], strains: &Strains, displacements: &[Point]) {
    let n = points.len();
    for joint in joints {
        let anchor = 3 * joint.piece;
        let (arriving, leaving) = ((anchor + n - 1) % n, anchor + 1);
        let (a, b) = (points[anchor] - points[arriving], points[leaving] - points[anchor]);
        let (length_a, length_b) = (a.norm(), b.norm());
        let [strain_a, strain_b] = joint.triangles.map(|triangle| strains.strain(triangle, displacements));
        if length_a == 0.0 || length_b == 0.0 || strain_a + strain_b == 0.0 {
            continue;
        }
        let (unit_a, unit_b) = (a * (1.0 / length_a), b * (1.0 / length_b));
        if unit_a.dot(unit_b) < CUSP {
            continue;
        }
        let between = unit_a * strain_b + unit_b * strain_a;
        let direction = between * (1.0 / between.norm());
        if strain_a > 0.0 {
            points[arriving] = points[anchor] - direction * length_a;
        }
        if strain_b > 0.0 {
            points[leaving] = points[anchor] + direction * length_b;
        }
    }
}

/// Cosine between two tangents below which a joint has become a cusp (turned by more than 150°) with no useful direction.
const CUSP: f64 = -0.866;

/// Largest angle between the tangents at `joints`, degrees.
#[must_use]
pub fn largest_kink(points: &[Point], joints: &[Joint]) -> f64 {
    let n = points.len();
    joints
        .iter()
        .map(|joint| {
            let anchor = 3 * joint.piece;
            let (a, b) = (points[anchor] - points[(anchor + n - 1) % n], points[anchor + 1] - points[anchor]);
            a.cross(b).atan2(a.dot(b)).abs().to_degrees()
        })
        .fold(0.0, f64::max)
}
