//! Repairs kinks: a piecewise affine warp is only C0, so tangents break where a smooth curve passes from one triangle to
//! the next. Both handles of such a joint are turned onto a common direction between them and keep their lengths, unless
//! that would take them out of their triangle: then they are shortened, so that nothing moves where the mesh rests.
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
    rest: Vec<Point>,
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
        Self { influences: influences.collect(), rest: mesh.rest.clone() }
    }

    /// Strain of one triangle; exactly 0 where no vertex is displaced.
    #[must_use]
    pub fn strain(&self, triangle: usize, displacements: &[Point]) -> f64 {
        let shares = self.influences[triangle].iter().map(|i| displacements[i.vertex].complex_mul(i.weight));
        shares.fold(Point::ZERO, |sum, share| sum + share).norm()
    }

    fn corners(&self, triangle: usize, displacements: &[Point]) -> [Point; 3] {
        self.influences[triangle].map(|i| self.rest[i.vertex] + displacements[i.vertex])
    }
}

/// Share of the way from `anchor` to the turned handle `to` that leaves the warped triangle `corners` nowhere further than
/// the handle `from` did before it turned: a piece whose control points are all inside cannot show outside. The edge that
/// the anchor lies on is crossed as the tangents on its both sides cross it.
fn room([a, b, c]: [Point; 3], anchor: Point, from: Point, to: Point) -> f64 {
    let area = (b - a).cross(c - a);
    [(a, b), (b, c), (c, a)].into_iter().fold(1.0, |share: f64, (p, q)| {
        let inside = |z: Point| (q - p).cross(z - p) / area;
        let (floor, start, end) = (inside(from).min(0.0), inside(anchor), inside(to));
        if start > ON_EDGE && end < floor { share.min((start - floor) / (start - end)) } else { share }
    })
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
        let sides = [(strain_a, arriving, direction * -length_a), (strain_b, leaving, direction * length_b)];
        for ((strain, handle, turned), triangle) in sides.into_iter().zip(joint.triangles) {
            if strain > 0.0 {
                let corners = strains.corners(triangle, displacements);
                let share = room(corners, points[anchor], points[handle], points[anchor] + turned);
                points[handle] = points[anchor] + turned * share;
            }
        }
    }
}

/// Barycentric coordinate up to which an anchor lies on an edge.
const ON_EDGE: f64 = 1e-9;

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

#[cfg(test)]
mod tests {
    use super::*;

    const CORNERS: [Point; 3] = [Point { x: 0.0, y: 0.0 }, Point { x: 4.0, y: 0.0 }, Point { x: 0.0, y: 4.0 }];

    #[test]
    fn a_handle_turned_out_of_its_triangle_stops_at_the_edge() {
        let (anchor, from, to) = (Point::new(0.0, 2.0), Point::new(1.0, 2.0), Point::new(1.0, -2.0));
        assert!((room(CORNERS, anchor, from, to) - 0.5).abs() < 1e-6);
        let mirrored = CORNERS.map(|corner| Point::new(-corner.x, corner.y));
        assert!((room(mirrored, anchor, Point::new(-1.0, 2.0), Point::new(-1.0, -2.0)) - 0.5).abs() < 1e-6);
    }

    #[test]
    fn a_handle_that_stays_inside_or_goes_out_no_further_keeps_its_length() {
        let anchor = Point::new(0.0, 2.0);
        assert_eq!(room(CORNERS, anchor, Point::new(1.0, 2.0), Point::new(1.0, 1.0)), 1.0);
        assert_eq!(room(CORNERS, anchor, Point::new(1.0, -2.0), Point::new(2.0, -1.5)), 1.0);
    }
}
