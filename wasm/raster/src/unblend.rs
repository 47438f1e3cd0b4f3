//! Carries the picture's gradient back through the blend of one tile.

use crate::fill::{Fill, FillGradient, Moments};
use crate::saturate::{coverage, grad_winding};
use crate::shade::{Place, Rgb, Shade};
use crate::walk::{Lane, ROWS};

/// Buffers of one tile, column by column.
#[derive(Debug)]
pub struct Columns<'a, const S: usize> {
    /// Resolved windings; their gradient afterwards.
    pub winding: &'a mut [[Lane; S]],
    /// Clip mask of the tile's columns.
    pub mask: Option<&'a [Lane]>,
    pub below: &'a [Rgb],
    /// `∂loss/∂C` above the tile; below it afterwards: `g ← g·(1 − α)`.
    pub grad: &'a mut [Rgb],
}

/// Replaces windings by their gradients, takes the gradient of the fill and passes the picture's gradient on.
pub fn unblend<const S: usize>(fill: &Fill, place: Place, columns: Columns<'_, S>) -> FillGradient {
    match fill.axis {
        None => unblend_with::<S, false>(fill, place, columns),
        Some(_) => unblend_with::<S, true>(fill, place, columns),
    }
}

fn unblend_with<const S: usize, const LINEAR: bool>(
    fill: &Fill,
    place: Place,
    columns: Columns<'_, S>,
) -> FillGradient {
    let mut shade = Shade::<LINEAR>::new(fill, place);
    let (mut sums, mut last) = ([[0.0_f32; ROWS]; 4], [[0.0_f32; ROWS]; 4]);
    let mut moments = Moments::ZERO;
    let mut x = place.column as f32 + 0.5;
    let buffers = columns.winding.iter_mut().zip(columns.below).zip(columns.grad);
    for (i, ((winding, below), g)) in buffers.enumerate() {
        let mask = columns.mask.map_or([1.0; ROWS], |mask| mask[i]);
        let covered = coverage(winding);
        let mut grad_coverage = [0.0; ROWS];
        for l in 0..ROWS {
            let s = shade.position(l);
            let (visible, opacity) = (covered[l] * mask[l], shade.channel(3, s));
            let alpha = visible * opacity;
            let (mut by_alpha, mut by_position) = (0.0, 0.0);
            for k in 0..3 {
                let flow = g[k][l] * alpha;
                by_alpha += g[k][l] * (shade.channel(k, s) - below[k][l]);
                sums[k][l] += flow;
                g[k][l] -= flow;
                if LINEAR {
                    last[k][l] += flow * s;
                    by_position += flow * shade.change(k);
                }
            }
            let by_opacity = by_alpha * visible;
            sums[3][l] += by_opacity;
            grad_coverage[l] = by_alpha * opacity * mask[l];
            if LINEAR {
                last[3][l] += by_opacity * s;
                let e = by_position + by_opacity * shade.change(3);
                moments.add(l, if shade.is_within(l) { e } else { 0.0 }, x, s);
            }
        }
        grad_winding(winding, &grad_coverage);
        shade.advance();
        x += 1.0;
    }
    let (sums, last) = (sums.map(total), last.map(total));
    let first = std::array::from_fn(|k| sums[k] - last[k]);
    let axis = fill.axis.as_ref().map_or([0.0; 4], |axis| axis.gradient(&moments, place.top));
    FillGradient { stops: [first, last], axis, importance: 0.0 }
}

/// Exact loss increase if the tile were removed, from columns as `unblend` gets them.
///
/// With `δ = α(B − c)` it is `Σ g·δ + q·|δ|²`, where the curvature `q = ½·∂²loss/∂C²` is the weight of a pixel times the
/// squared transmittance of what lies above; it is passed on: `q ← q·(1 − α)²`.
pub fn removal<const S: usize>(fill: &Fill, place: Place, columns: &Columns<'_, S>, curvature: &mut [Lane]) -> f64 {
    let mut shade = Shade::<true>::new(fill, place);
    let mut sums = [0.0_f64; ROWS];
    for (i, q) in curvature.iter_mut().enumerate() {
        let (below, g) = (&columns.below[i], &columns.grad[i]);
        let mask = columns.mask.map_or([1.0; ROWS], |mask| mask[i]);
        let covered = coverage(&columns.winding[i]);
        for l in 0..ROWS {
            let s = shade.position(l);
            let alpha = covered[l] * mask[l] * shade.channel(3, s);
            let (mut slope, mut square) = (0.0, 0.0);
            for k in 0..3 {
                let change = alpha * (below[k][l] - shade.channel(k, s));
                slope += g[k][l] * change;
                square += change * change;
            }
            sums[l] += f64::from(slope + q[l] * square);
            q[l] *= (1.0 - alpha) * (1.0 - alpha);
        }
        shade.advance();
    }
    sums.iter().sum()
}

fn total(lane: Lane) -> f32 {
    lane.iter().sum()
}
