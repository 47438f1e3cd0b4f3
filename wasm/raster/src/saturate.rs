//! Turns winding into coverage by the nonzero rule, and gradients by coverage into gradients by winding.
//!
//! A column has one lane of windings for each of its `S` sub-rows; its coverage is the mean of `min(|winding|, 1)` over them.

use crate::lane::{Lane, ROWS, ZERO};

/// Rounding of long sums leaves this much winding where there is none.
const SNAP: f32 = 1e-4;
/// Above this much winding coverage is saturated and does not answer to a path's outline.
const SATURATED: f32 = 1.0005;

/// Advances running sums by one column of differences, stores the windings there and returns the coverage.
#[inline(always)]
pub fn resolve<const S: usize>(running: &mut [Lane; S], column: &mut [Lane; S]) -> Lane {
    for (run, cells) in running.iter_mut().zip(column.iter_mut()) {
        *run += *cells;
        *cells = *run;
    }
    coverage(column)
}

/// Coverage of a column whose windings are resolved.
#[inline(always)]
pub fn coverage<const S: usize>(column: &[Lane; S]) -> Lane {
    let mut sum = ZERO;
    for cells in column {
        sum += saturate(*cells);
    }
    if S == 1 { sum } else { sum * (1.0 / S as f32) }
}

#[inline(always)]
fn saturate(winding: Lane) -> Lane {
    let w = winding.abs();
    let wound = w.simd_gt(Lane::splat(SNAP)) & w;
    w.simd_lt(Lane::splat(1.0 - SNAP)).select(wound, Lane::ONE)
}

/// Replaces a column's windings by gradients of the loss by them, given those by its coverage.
///
/// The factor `1/S` of the mean cancels against the `S` times finer rows of the boundary integral.
#[inline(always)]
pub fn grad_winding<const S: usize>(column: &mut [Lane; S], grad_coverage: Lane) {
    for cells in column {
        let sign = *cells & Lane::splat(-0.0);
        *cells = cells.abs().simd_le(Lane::splat(SATURATED)) & (grad_coverage ^ sign);
    }
}

/// How a path lies over itself, in pixel areas.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Overlap {
    /// Covered area.
    pub covered: f64,
    /// The part of it that is wound around more than once.
    pub folded: f64,
    /// The part of it that is wound against the path's main direction.
    pub reversed: f64,
}

/// Measures resolved windings, each of so many columns, of which `height` pixel rows are inside the frame.
pub fn overlap<const S: usize>(columns: &[(usize, [Lane; S])], height: usize) -> Overlap {
    let rows = height.min(ROWS);
    let cells = columns.iter().flat_map(|(times, lanes)| {
        let times = *times as f64;
        lanes.iter().flat_map(move |lane| lane.as_array()[..rows].iter().map(move |&w| (times, w)))
    });
    let main = cells.clone().map(|(times, w)| times * f64::from(w)).sum::<f64>().signum();
    let mut found = Overlap::default();
    for (times, w) in cells {
        let area = times * f64::from(*saturate(Lane::splat(w)).as_array().first().unwrap_or(&0.0)) / S as f64;
        found.covered += area;
        found.folded += if w.abs() > SATURATED { area } else { 0.0 };
        found.reversed += if f64::from(w) * main < 0.0 { area } else { 0.0 };
    }
    found
}
