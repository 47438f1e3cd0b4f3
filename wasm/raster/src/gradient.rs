//! Carries winding gradients to control points by the boundary integral (Reynolds' transport theorem).

use crate::clip::Piece;
use crate::flatten::Chords;
use crate::walk::Passage;

/// Pieces of a band with their passages, and the gradient of the loss by the winding of every cell.
#[derive(Debug)]
pub struct Boundary<'a> {
    pub pieces: &'a [Piece],
    /// First passage of each piece, and the end of the last one's.
    pub starts: &'a [usize],
    pub passages: &'a [Passage],
    pub grad_winding: &'a [f32],
}

/// Adds the gradients of one path's pieces to its control points, `grad_points [S, 3, 2]`.
///
/// For a chord `P(t) = (1 − t)·P0 + t·P1`, `Δ = P1 − P0` and `G = ∂loss/∂winding`: `∂loss/∂P1 = (−Δy, Δx)·∫G·t dt`, likewise
/// `P0` with `1 − t`; downward edges wind positively to their right.
pub fn add_path(chords: &Chords, boundary: &Boundary<'_>, grad_points: &mut [f32]) {
    let mut index = 0;
    for run in boundary.pieces.chunk_by(|a, b| a.segment == b.segment) {
        let segment = run[0].segment as usize;
        let step = 1.0 / chords.count[segment] as f32;
        let mut moments = [[0.0_f32; 4]; 2];
        for piece in run {
            let passages = &boundary.passages[boundary.starts[index]..boundary.starts[index + 1]];
            index += 1;
            let [start, end] = integrate(piece, passages, boundary.grad_winding);
            let v = piece.vertex as usize;
            let normal = [chords.y[v] - chords.y[v + 1], chords.x[v + 1] - chords.x[v]];
            let k = (piece.vertex - chords.start[segment]) as f32;
            let (at_start, at_end) = (powers(k * step), powers((k + 1.0) * step));
            for power in 0..4 {
                let share = at_start[power] * start + at_end[power] * end;
                moments[0][power] += share * normal[0];
                moments[1][power] += share * normal[1];
            }
        }
        let first = segment % chords.segments * 6;
        for (axis, m) in moments.into_iter().enumerate() {
            for (j, g) in bernstein(m).into_iter().enumerate() {
                grad_points[(first + 2 * j + axis) % (6 * chords.segments)] += g;
            }
        }
    }
}

/// `∫G·(1 − t) dt` and `∫G·t dt` over the part of the chord that a piece is.
fn integrate(piece: &Piece, passages: &[Passage], grad_winding: &[f32]) -> [f32; 2] {
    let (mut whole, mut first, mut start) = (0.0_f32, 0.0_f32, 0.0_f32);
    for passage in passages {
        let g = grad_winding[passage.cell as usize] * (passage.end - start);
        whole += g;
        first += g * (passage.end + start);
        start = passage.end;
    }
    let end = piece.share * (piece.t0 * whole + 0.5 * piece.share * first);
    [piece.share * whole - end, end]
}

fn powers(t: f32) -> [f32; 4] {
    [1.0, t, t * t, t * t * t]
}

/// Sums over powers of `t` turned into sums over the Bernstein weights of the four control points.
fn bernstein([m0, m1, m2, m3]: [f32; 4]) -> [f32; 4] {
    [m0 - 3.0 * (m1 - m2) - m3, 3.0 * (m1 - 2.0 * m2 + m3), 3.0 * (m2 - m3), m3]
}
