//! Adds the exact signed areas of a chord to the cells that it crosses, all rows of a band at a time.

use crate::clip::Piece;
use crate::lane::{Lane, ZERO, cut, least, most, rows};

/// Sub-rows; a chord of less height changes no winding that could be told from rounding.
const LEAST_HEIGHT: f32 = 1e-6;

/// Adds differences of winding along x to `cells`, one column after the other from the piece's first on, and one more.
///
/// A passage through a cell over height `d` at mean distance `m` from its left side covers `d·(1 − m)` of the cell and all `d`
/// of the cells to the right of it, hence `d·m` more from the next cell on.
#[inline]
pub fn walk<const S: usize>(piece: &Piece, cells: &mut [[Lane; S]]) {
    let line = &piece.line;
    let (low, high, dy) = (line.low(), line.high(), line.end - line.y);
    if high - low < LEAST_HEIGHT {
        return;
    }
    let (slope, inverse) = (dy / line.dx, Lane::splat(line.dx / dy));
    let downward = if line.along == (dy > 0.0) { Lane::ONE } else { -Lane::ONE };
    let rows = subrows::<S>().map(|[top, bottom]| [top, bottom].map(|y| y.fast_clamp(low.into(), high.into())));
    let height = |[top, bottom]: [Lane; 2], from: f32, to: f32| {
        let (first, last) = (top.fast_max(Lane::splat(least(from, to))), bottom.fast_min(Lane::splat(most(from, to))));
        (((last - first).fast_max(ZERO)) * downward, first + last)
    };
    let crossing = |x: u32| cut(line.y + (x as i32 as f32 - line.x) * slope, low, high);

    let mut enter = line.y;
    if piece.left {
        let border = if piece.columns() == 0 { line.end } else { crossing(0) };
        for s in 0..S {
            cells[0][s] += height(rows[s], enter, border).0;
        }
        enter = border;
    }
    let mut carried = [ZERO; S];
    let (cells, beyond) = cells.split_at_mut(piece.columns());
    for (column, cell) in (piece.first..).zip(cells) {
        let leave = if column + 1 < piece.last || piece.right { crossing(column + 1) } else { line.end };
        let offset = Lane::splat(line.x - column as i32 as f32);
        for s in 0..S {
            let (d, sum) = height(rows[s], enter, leave);
            let m = ((sum * 0.5 - line.y).mul_add(inverse, offset)).fast_min(Lane::ONE).fast_max(ZERO);
            let dm = d * m;
            cell[s] += (d - dm) + carried[s];
            carried[s] = dm;
        }
        enter = leave;
    }
    for s in 0..S {
        beyond[0][s] += carried[s];
    }
}

/// `∫G dt` and `∫G·t dt` along a chord inside the canvas, `G = ∂loss/∂winding` of the cells from the piece's first on.
#[inline]
pub fn integrate<const S: usize>(piece: &Piece, grad_winding: &[[Lane; S]]) -> [f32; 2] {
    let line = &piece.line;
    let steepness = 1.0 / (line.end - line.y);
    // A horizontal chord is all in the row below it: any finite steepness that is large enough puts it there.
    let steepness = if steepness.abs() < 1.0 / LEAST_HEIGHT { steepness } else { steepness.signum() / LEAST_HEIGHT };
    let passages = subrows::<S>().map(|sides| {
        let [a, b] = sides.map(|y| ((y - line.y) * steepness).fast_clamp(ZERO, Lane::ONE));
        [a.fast_min(b), a.fast_max(b)]
    });
    let slope = 1.0 / line.dx;
    let crossing = |x: u32| cut((x as i32 as f32 - line.x) * slope, 0.0, 1.0);

    let mut enter = if piece.left { crossing(0) } else { 0.0 };
    let (mut whole, mut first) = (ZERO, ZERO);
    for (column, grad) in (piece.first..piece.last).zip(grad_winding) {
        let leave = if column + 1 < piece.last || piece.right { crossing(column + 1) } else { 1.0 };
        for s in 0..S {
            let (a, b) = (passages[s][0].fast_max(enter.into()), passages[s][1].fast_min(leave.into()));
            let share = grad[s] * (b - a).fast_max(ZERO);
            whole += share;
            first = share.mul_add(a + b, first);
        }
        enter = leave;
    }
    let (whole, first) = (whole.reduce_add(), 0.5 * first.reduce_add());
    [whole, if line.along { first } else { whole - first }]
}

/// Upper and lower sides of every sub-row, in sub-rows of which a pixel has `S`.
fn subrows<const S: usize>() -> [[Lane; 2]; S] {
    std::array::from_fn(|s| {
        let top = rows() * S as f32 + s as f32;
        [top, top + 1.0]
    })
}
