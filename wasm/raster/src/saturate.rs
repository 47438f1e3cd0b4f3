//! Turns winding into coverage by the nonzero rule, and gradients by coverage into gradients by winding.
//!
//! A column has one lane of windings for each of its `S` sub-rows; its coverage is the mean of `min(|winding|, 1)` over them.

use crate::walk::{Lane, ROWS};

/// Rounding of long sums leaves this much winding where there is none.
const SNAP: f32 = 1e-4;
/// Above this much winding coverage is saturated and does not answer to a path's outline.
const SATURATED: f32 = 1.0005;

/// Advances running sums by one column of differences, stores the windings there and returns the coverage.
#[inline(always)]
pub fn resolve<const S: usize>(running: &mut [Lane; S], column: &mut [Lane; S]) -> Lane {
    for (run, cells) in running.iter_mut().zip(column.iter_mut()) {
        for l in 0..ROWS {
            run[l] += cells[l];
        }
        *cells = *run;
    }
    coverage(column)
}

/// Coverage of a column whose windings are resolved.
#[inline(always)]
pub fn coverage<const S: usize>(column: &[Lane; S]) -> Lane {
    let mut sum = [0.0; ROWS];
    for cells in column {
        for l in 0..ROWS {
            sum[l] += saturate(cells[l]);
        }
    }
    sum.map(|v| v * (1.0 / S as f32))
}

#[inline(always)]
fn saturate(winding: f32) -> f32 {
    let w = winding.abs();
    let w = if w < SNAP { 0.0 } else { w };
    if w > 1.0 - SNAP { 1.0 } else { w }
}

/// Replaces a column's windings by gradients of the loss by them, given those by its coverage.
///
/// The factor `1/S` of the mean cancels against the `S` times finer rows of the boundary integral.
#[inline(always)]
pub fn grad_winding<const S: usize>(column: &mut [Lane; S], grad_coverage: &Lane) {
    for cells in column {
        for l in 0..ROWS {
            let answers = cells[l].abs() <= SATURATED;
            cells[l] = if answers { grad_coverage[l] * cells[l].signum() } else { 0.0 };
        }
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

/// Measures the resolved windings of a tile, of which `height` pixel rows are inside the frame.
pub fn overlap<const S: usize>(columns: &[[Lane; S]], height: usize) -> Overlap {
    let cells = columns.as_flattened().iter().flat_map(|lane| &lane[..height]);
    let main = cells.clone().map(|&w| f64::from(w)).sum::<f64>().signum();
    let mut found = Overlap::default();
    for &w in cells {
        let area = f64::from(saturate(w)) / S as f64;
        found.covered += area;
        found.folded += if w.abs() > SATURATED { area } else { 0.0 };
        found.reversed += if f64::from(w) * main < 0.0 { area } else { 0.0 };
    }
    found
}
