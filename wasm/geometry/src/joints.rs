//! Repairs kinks: a piecewise affine warp is only C0, so tangents break where a smooth curve passes from one triangle to
//! the next. Both handles of such a joint are turned onto their common bisector and keep their lengths.
//!
//! The repair is exact at rest. It is not linear in the vertices.

use crate::mesh::Mesh;
use crate::point::Point;
use crate::split::{Anchor, SplitPath};

/// Joints (piece indices) that are smooth at rest and join two triangles across a common edge. Splits on a slit are not
/// among them: there the curve is meant to tear.
#[must_use]
pub fn smooth_joints(path: &SplitPath, mesh: &Mesh) -> Vec<usize> {
    let n = path.anchors.len();
    (0..n)
        .filter(|&j| {
            let Anchor::Edge { edge, .. } = path.anchors[j] else {
                return false;
            };
            let (before, after) = (path.triangles[(j + n - 1) % n], path.triangles[j]);
            let shares_edge = |triangle: usize| {
                mesh.edges[edge].iter().all(|vertex| mesh.triangles[triangle].vertices.contains(vertex))
            };
            before != after && shares_edge(before) && shares_edge(after)
        })
        .collect()
}

/// Turns the handles at `joints` of a warped closed path onto their bisector.
pub fn repair(points: &mut [Point], joints: &[usize]) {
    let n = points.len();
    for &joint in joints {
        let anchor = 3 * joint;
        let (arriving, leaving) = ((anchor + n - 1) % n, anchor + 1);
        let (a, b) = (points[anchor] - points[arriving], points[leaving] - points[anchor]);
        let (length_a, length_b) = (a.norm(), b.norm());
        if length_a == 0.0 || length_b == 0.0 {
            continue;
        }
        let sum = a * (1.0 / length_a) + b * (1.0 / length_b);
        let length = sum.norm();
        if length < CUSP {
            continue;
        }
        let direction = sum * (1.0 / length);
        points[arriving] = points[anchor] - direction * length_a;
        points[leaving] = points[anchor] + direction * length_b;
    }
}

/// Sum of two unit tangents below which a joint has become a cusp (turned by more than 150°) with no useful bisector.
const CUSP: f64 = 0.5;

/// Largest angle between the tangents at `joints`, degrees.
#[must_use]
pub fn largest_kink(points: &[Point], joints: &[usize]) -> f64 {
    let n = points.len();
    joints
        .iter()
        .map(|&joint| {
            let anchor = 3 * joint;
            let (a, b) = (points[anchor] - points[(anchor + n - 1) % n], points[anchor + 1] - points[anchor]);
            a.cross(b).atan2(a.dot(b)).abs().to_degrees()
        })
        .fold(0.0, f64::max)
}
