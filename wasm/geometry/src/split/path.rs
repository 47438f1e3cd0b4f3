//! Splits one closed path at all mesh edges and remembers to what each anchor and piece belongs.

use super::crossings::{Crossing, PARAMETER_TOLERANCE, push_crossings};
use crate::cubic::{Cubic, eval, segment, split_at};
use crate::mesh::Mesh;
use crate::mesh::grid::Grid;
use crate::point::Point;

/// Where a piece starts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Anchor {
    /// An anchor of the source path.
    Source,
    /// A crossing with the edge between two vertices, at `s` along it; both neighbouring pieces share this one point.
    Edge { ends: [usize; 2], s: f64 },
}

/// A closed chain of pieces; entry `j` of `anchors` and `triangles` belongs to piece `j` of `points`.
#[derive(Clone, Debug, Default)]
pub struct SplitPath {
    pub points: Vec<Point>,
    pub anchors: Vec<Anchor>,
    /// Triangle that contains the piece's middle, eval(½): its ends lie on edges and decide nothing.
    /// None for a bridge across a slit, which is a mere point at rest: its handles lie on its ends.
    pub triangles: Vec<Option<usize>>,
}

/// Splits a closed path `anchor, handle, handle, …` at its crossings with all edges.
#[must_use]
pub fn split_path(points: &[Point], mesh: &Mesh, grid: &Grid) -> SplitPath {
    let mut path = SplitPath::default();
    let mut near = Vec::new();
    let mut found: Vec<(Crossing, usize)> = Vec::new();
    let mut on_edge = Vec::new();
    for j in 0..points.len() / 3 {
        let curve = segment(points, j);
        found.clear();
        grid.edges_near(&curve, &mut near);
        for &edge in &near {
            let [a, b] = mesh.edges[edge as usize].map(|vertex| mesh.rest[vertex]);
            on_edge.clear();
            push_crossings(&curve, a, b, &mut on_edge);
            found.extend(on_edge.iter().map(|&crossing| (crossing, edge as usize)));
        }
        found.sort_by(|(a, _), (b, _)| a.t.total_cmp(&b.t));
        // Crossings that coincide happen at a mesh vertex: either edge will do there.
        found.dedup_by(|(later, _), (kept, _)| later.t - kept.t < PARAMETER_TOLERANCE);
        path.push_pieces(&curve, &found, mesh, grid);
    }
    path
}

/// The path as it is, each source segment one piece (paths that are not split).
#[must_use]
pub fn keep_path(points: &[Point], mesh: &Mesh, grid: &Grid) -> SplitPath {
    let mut path = SplitPath::default();
    for j in 0..points.len() / 3 {
        path.push_pieces(&segment(points, j), &[], mesh, grid);
    }
    path
}

impl SplitPath {
    fn push_pieces(&mut self, curve: &Cubic, crossings: &[(Crossing, usize)], mesh: &Mesh, grid: &Grid) {
        let ts: Vec<f64> = crossings.iter().map(|(crossing, _)| crossing.t).collect();
        let mut before = None;
        for (k, piece) in split_at(curve, &ts).iter().enumerate() {
            let triangle = grid.locate(mesh, eval(piece, 0.5));
            let mut anchor = Anchor::Source;
            if let (Some(from), Some(&(Crossing { s, .. }, edge))) = (before, k.checked_sub(1).map(|k| &crossings[k])) {
                let (leaving, arriving) = (mesh.side_of_edge(edge, from), mesh.side_of_edge(edge, triangle));
                if leaving != arriving {
                    self.push([piece[0]; 3], Anchor::Edge { ends: leaving, s }, None);
                }
                anchor = Anchor::Edge { ends: arriving, s };
            }
            self.push([piece[0], piece[1], piece[2]], anchor, Some(triangle));
            before = Some(triangle);
        }
    }

    fn push(&mut self, points: [Point; 3], anchor: Anchor, triangle: Option<usize>) {
        self.points.extend_from_slice(&points);
        self.anchors.push(anchor);
        self.triangles.push(triangle);
    }
}
