//! Turns winding differences into coverage by the nonzero rule.

use crate::walk::{Lane, ROWS};

/// Rounding of long sums leaves this much winding where there is none.
const SNAP: f32 = 1e-4;
/// Above this much winding coverage is saturated and does not answer to a path's outline.
const SATURATED: f32 = 1.0005;

/// How often a path lies over itself, in pixel areas.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Overlap {
    /// Covered area.
    pub covered: f64,
    /// The part of it that is wound around more than once.
    pub folded: f64,
    /// The part of it that is wound against the path's main direction.
    pub reversed: f64,
}

/// Sums differences along x in place and averages `min(|winding|, 1)` over the `S` sub-rows of each pixel.
///
/// `winding` holds `S` lanes a column and one column more than `coverage`.
pub fn resolve<const S: usize>(winding: &mut [Lane], coverage: &mut [Lane]) {
    let mut running = [[0.0_f32; ROWS]; S];
    for (column, covered) in winding.as_chunks_mut::<S>().0.iter_mut().zip(coverage) {
        let mut sum = [0.0_f32; ROWS];
        for (run, cells) in running.iter_mut().zip(column) {
            for l in 0..ROWS {
                run[l] += cells[l];
                sum[l] += saturate(run[l]);
            }
            *cells = *run;
        }
        for l in 0..ROWS {
            covered[l] = sum[l] * (1.0 / S as f32);
        }
    }
}

fn saturate(winding: f32) -> f32 {
    let w = winding.abs();
    let w = if w < SNAP { 0.0 } else { w };
    if w > 1.0 - SNAP { 1.0 } else { w }
}

/// Turns the windings of a tile into gradients of the loss by them, given those by its coverage.
///
/// The factor `1/S` of the average cancels against the `S` times finer rows of the boundary integral.
pub fn grad_winding<const S: usize>(winding: &mut [Lane], grad_coverage: &[Lane]) {
    for (column, grad) in winding.as_chunks_mut::<S>().0.iter_mut().zip(grad_coverage) {
        for cells in column {
            for l in 0..ROWS {
                let saturated = cells[l].abs() > SATURATED;
                cells[l] = if saturated {
                    0.0
                } else {
                    grad[l] * cells[l].signum()
                };
            }
        }
    }
}

/// Measures how a tile's path lies over itself; `height` pixel rows are inside the frame.
pub fn overlap(winding: &[Lane], subrows: usize, columns: usize, height: usize) -> Overlap {
    let cells = winding[..columns * subrows]
        .iter()
        .flat_map(|lane| &lane[..height]);
    let main = cells.clone().map(|&w| f64::from(w)).sum::<f64>().signum();
    let mut found = Overlap::default();
    for &w in cells {
        let area = f64::from(saturate(w)) / subrows as f64;
        found.covered += area;
        found.folded += if w.abs() > SATURATED { area } else { 0.0 };
        found.reversed += if f64::from(w) * main < 0.0 { area } else { 0.0 };
    }
    found
}
