//! Counts which samples of a grid lie right of a chord, as tiny-skia does for every path and Skia for most.

use crate::clip::Piece;
use crate::lane::{Lane, ZERO, rows};

/// Samples of a pixel along x.
const COLUMNS: f32 = 4.0;

/// Adds differences of winding along x to `cells`, one column after the other from the piece's first on, and one more.
///
/// A chord crosses a sub-row where its centre line does, rounded to a quarter of a pixel; one that ends on the line is above it.
#[inline]
pub fn sample<const S: usize>(piece: &Piece, cells: &mut [[Lane; S]]) {
    let line = &piece.line;
    let (low, high, dy) = (Lane::splat(line.low()), Lane::splat(line.high()), line.end - line.y);
    if dy == 0.0 {
        return;
    }
    let inverse = Lane::splat(line.dx / dy);
    let downward = if line.along == (dy > 0.0) { Lane::ONE } else { -Lane::ONE };
    let (cells, beyond) = cells.split_at_mut(piece.columns());
    for s in 0..S {
        let centre = rows() * S as f32 + (s as f32 + 0.5);
        let wound = centre.simd_ge(low) & centre.simd_lt(high) & downward;
        let x = (centre - line.y).mul_add(inverse, Lane::splat(line.x));
        let x = (x * COLUMNS + 0.5).floor() * (1.0 / COLUMNS);
        let mut carried = ZERO;
        for (column, cell) in (piece.first + 1..).zip(cells.iter_mut()) {
            let covered = wound * (Lane::splat(column as i32 as f32) - x).fast_max(ZERO).fast_min(Lane::ONE);
            cell[s] += covered - carried;
            carried = covered;
        }
        beyond[0][s] += wound - carried;
    }
}
