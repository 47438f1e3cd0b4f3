//! Turns a residual into the energy that it has after averaging: where errors agree in sign over a box.

use crate::error::Error;
use crate::scene::{MAX_SIDE, length, size};

/// Channels of a residual.
const RGB: usize = 3;

/// `|box mean of weight · residual|²`, `[height, width]`, of `residual [height, width, 3]` and `weight [height, width]`.
///
/// The box has `2·reach + 1` pixels a side; outside the picture the residual is zero.
pub fn coherent_energy(
    residual: &[f32],
    weight: &[f32],
    (width, height): (usize, usize),
    reach: usize,
) -> Result<Vec<f32>, Error> {
    size("width", width, 1, MAX_SIDE)?;
    size("height", height, 1, MAX_SIDE)?;
    length("residual", residual, RGB * width * height)?;
    length("weight", weight, width * height)?;
    let area = ((2 * reach + 1) * (2 * reach + 1)) as f64;
    let mut energy = vec![0.0; width * height];
    let mut columns = vec![[0.0_f64; RGB]; width];
    for y in 0..reach.min(height) {
        add_row(&mut columns, residual, weight, y, 1.0);
    }
    for (y, out) in energy.chunks_exact_mut(width).enumerate() {
        if y + reach < height {
            add_row(&mut columns, residual, weight, y + reach, 1.0);
        }
        if y > reach {
            add_row(&mut columns, residual, weight, y - reach - 1, -1.0);
        }
        let mut sum = [0.0_f64; RGB];
        for column in &columns[..reach.min(width)] {
            add(&mut sum, column, 1.0);
        }
        for (x, out) in out.iter_mut().enumerate() {
            if x + reach < width {
                add(&mut sum, &columns[x + reach], 1.0);
            }
            if x > reach {
                add(&mut sum, &columns[x - reach - 1], -1.0);
            }
            *out = (sum.iter().map(|s| s * s).sum::<f64>() / (area * area)) as f32;
        }
    }
    Ok(energy)
}

fn add_row(columns: &mut [[f64; RGB]], residual: &[f32], weight: &[f32], y: usize, times: f64) {
    let row = y * columns.len();
    for (i, column) in columns.iter_mut().enumerate() {
        let weight = times * f64::from(weight[row + i]);
        for (sum, value) in column.iter_mut().zip(&residual[RGB * (row + i)..]) {
            *sum += weight * f64::from(*value);
        }
    }
}

fn add(sum: &mut [f64; RGB], column: &[f64; RGB], times: f64) {
    for (s, c) in sum.iter_mut().zip(column) {
        *s += times * c;
    }
}
