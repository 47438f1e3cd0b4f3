//! Carries coverage gradients to control points by the boundary integral (Reynolds' transport theorem).

use crate::cells::{Lane, Passage, Piece};
use crate::flatten::{Chords, bernstein};
use crate::resolve::slope;

/// What the boundary integral reads: windings and coverage gradients of one tile.
#[derive(Debug)]
pub struct Field<'a> {
    /// Windings of the whole band.
    pub winding: &'a [f32],
    /// Gradient of the loss by coverage, the tile's columns.
    pub grad_coverage: &'a [Lane],
    /// First winding cell of the tile.
    pub base: usize,
    pub subrows: usize,
}

impl Field<'_> {
    /// Gradient of the loss by the winding of a cell, times the number of sub-rows.
    fn at(&self, cell: u32) -> f32 {
        let local = cell as usize - self.base;
        let rows = crate::cells::ROWS;
        self.grad_coverage[local / (rows * self.subrows)][local % rows]
            * slope(self.winding[cell as usize])
    }
}

/// Adds the gradient of one piece to its segment's path, `grad_points [S, 3, 2]`.
///
/// For a chord `P(t) = (1 − t)·P0 + t·P1`, `Δ = P1 − P0` and `G = ∂loss/∂winding`: `∂loss/∂P1 = (−Δy, Δx)·∫G·t dt`, likewise
/// `P0` with `1 − t`; downward edges wind positively to their right.
pub fn add_piece(
    chords: &Chords,
    field: &Field<'_>,
    piece: &Piece,
    passages: &[Passage],
    grad_points: &mut [f32],
) {
    let (mut whole, mut first, mut start) = (0.0_f32, 0.0_f32, 0.0_f32);
    for passage in passages {
        let g = field.at(passage.cell);
        let length = passage.end - start;
        whole += g * length;
        first += g * length * 0.5 * (passage.end + start);
        start = passage.end;
    }
    let towards_end = piece.share * (piece.t0 * whole + piece.share * first);
    let towards_start = piece.share * whole - towards_end;

    let (v, segment) = (piece.vertex as usize, piece.segment as usize);
    let normal = [chords.y[v] - chords.y[v + 1], chords.x[v + 1] - chords.x[v]];
    let step = 1.0 / chords.count[segment] as f32;
    let k = (piece.vertex - chords.start[segment]) as f32;
    let (at_start, at_end) = (bernstein(k * step), bernstein((k + 1.0) * step));
    let first_point = segment % chords.segments * 6;
    for j in 0..4 {
        let share = at_start[j] * towards_start + at_end[j] * towards_end;
        let i = (first_point + 2 * j) % grad_points.len();
        grad_points[i] += share * normal[0];
        grad_points[i + 1] += share * normal[1];
    }
}
