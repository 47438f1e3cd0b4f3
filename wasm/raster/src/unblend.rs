//! Carries the picture's gradient back through the blend of a span, and finds what its removal would cost.

use crate::lane::{Lane, Rgb, ZERO};
use crate::saturate::{coverage, grad_winding};
use crate::shade::{Shade, Totals};

/// Colours below the tile and the picture's gradient above it over some columns; the gradient below it afterwards:
/// `g ← g·(1 − α)`.
#[derive(Debug)]
pub struct Canvas<'a> {
    pub below: &'a [Rgb],
    pub grad: &'a mut [Rgb],
}

/// Edge columns: replaces their windings by gradients, adds the fill's to `totals` and passes the picture's on.
pub fn unblend_edges<const S: usize>(
    mut shade: impl Shade,
    winding: &mut [[Lane; S]],
    mask: Option<&[Lane]>,
    canvas: Canvas<'_>,
    totals: &mut Totals,
) {
    let start = shade;
    let mut sums = nothing(&shade);
    let columns = winding.iter_mut().zip(canvas.below).zip(canvas.grad);
    for (i, ((winding, below), g)) in columns.enumerate() {
        let covered = coverage(winding);
        let visible = mask.map_or(covered, |mask| covered * mask[i]);
        let by_visible = unblend_column(&shade, &mut sums, visible, below, g);
        grad_winding(winding, mask.map_or(by_visible, |mask| by_visible * mask[i]));
        shade.advance();
    }
    start.total(&sums, totals);
}

/// Columns of the same coverage: the outline does not touch them.
pub fn unblend_flat(mut shade: impl Shade, covered: Lane, canvas: Canvas<'_>, totals: &mut Totals) {
    let start = shade;
    let mut sums = nothing(&shade);
    for (below, g) in canvas.below.iter().zip(canvas.grad) {
        unblend_column(&shade, &mut sums, covered, below, g);
        shade.advance();
    }
    start.total(&sums, totals);
}

fn nothing<T: Shade>(_: &T) -> T::Sums {
    T::NOTHING
}

/// Passes `g` on below one column and returns `∂loss/∂visible`.
#[inline(always)]
fn unblend_column<T: Shade>(shade: &T, sums: &mut T::Sums, visible: Lane, below: &Rgb, g: &mut Rgb) -> Lane {
    let opacity = shade.channel(3);
    let alpha = visible * opacity;
    let (mut by_alpha, mut grad) = (ZERO, [ZERO; 4]);
    for k in 0..3 {
        by_alpha = g[k].mul_add(shade.channel(k) - below[k], by_alpha);
        grad[k] = g[k] * alpha;
        g[k] -= grad[k];
    }
    grad[3] = by_alpha * visible;
    shade.add(sums, grad);
    by_alpha * opacity
}

/// Exact loss increase if a column were removed, row by row, before it is unblended.
///
/// With `δ = α(B − c)` it is `Σ g·δ + q·|δ|²`, where the curvature `q = ½·∂²loss/∂C²` is the weight of a pixel times the
/// squared transmittance of what lies above; it is passed on: `q ← q·(1 − α)²`.
#[inline(always)]
pub fn remove_column(shade: &impl Shade, visible: Lane, below: &Rgb, g: &Rgb, q: &mut Lane) -> Lane {
    let alpha = visible * shade.channel(3);
    let (mut slope, mut square) = (ZERO, ZERO);
    for k in 0..3 {
        let change = alpha * (below[k] - shade.channel(k));
        slope = g[k].mul_add(change, slope);
        square = change.mul_add(change, square);
    }
    let increase = q.mul_add(square, slope);
    let through = Lane::ONE - alpha;
    *q *= through * through;
    increase
}
