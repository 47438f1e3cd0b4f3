//! Blends a tile into the picture, and carries the picture's gradient back through the blend.
//!
//! Both passes keep the colour *below* each path: un-compositing by `1/(1 − α)` would break on opaque paths.

use crate::fill::{Fill, FillGradient, Moments};
use crate::walk::{Lane, ROWS};

/// One column of colours, channel by channel.
pub type Rgb = [Lane; 3];

/// `C ← C + α(c − C)` over the tile's columns, keeping the former `C` in `below`.
pub fn blend(fill: &Fill, place: Place, coverage: &[Lane], picture: &mut [Rgb], below: &mut [Rgb]) {
    match &fill.axis {
        None => {
            let [colour @ .., opacity] = fill.first;
            for ((covered, c), b) in coverage.iter().zip(picture).zip(below) {
                *b = *c;
                for l in 0..ROWS {
                    let alpha = covered[l] * opacity;
                    for k in 0..3 {
                        c[k][l] += alpha * (colour[k] - c[k][l]);
                    }
                }
            }
        }
        Some(axis) => {
            let (mut position, step) = axis.ramp(place.top, place.column);
            for ((covered, c), b) in coverage.iter().zip(picture).zip(below) {
                *b = *c;
                for l in 0..ROWS {
                    let s = position[l].clamp(0.0, 1.0);
                    position[l] += step;
                    let alpha = covered[l] * (fill.first[3] + s * fill.change[3]);
                    for k in 0..3 {
                        c[k][l] += alpha * (fill.first[k] + s * fill.change[k] - c[k][l]);
                    }
                }
            }
        }
    }
}

/// First row and column of a tile in the frame.
#[derive(Debug, Clone, Copy)]
pub struct Place {
    pub top: usize,
    pub column: usize,
}

/// Rounds to 8 bits, as renderers store every blend.
pub fn quantise(picture: &mut [Rgb]) {
    for lane in picture.as_flattened_mut() {
        for v in lane {
            *v = (*v * 255.0).round_ties_even() * (1.0 / 255.0);
        }
    }
}

/// What flows down through the blends of a band.
#[derive(Debug)]
pub struct Upstream<'a> {
    /// `∂loss/∂C`, the tile's columns.
    pub grad: &'a mut [Rgb],
    /// Curvature `½·∂²loss/∂C²`: the weight of a pixel times the squared transmittance of what lies above.
    pub curvature: Option<&'a mut [Lane]>,
}

/// Turns `coverage` into its gradient, takes the path's fill gradient and passes the rest on: `g ← g·(1 − α)`.
pub fn unblend(
    fill: &Fill,
    place: Place,
    coverage: &mut [Lane],
    below: &[Rgb],
    upstream: Upstream<'_>,
) -> FillGradient {
    let importance = match upstream.curvature {
        Some(curvature) => removal(fill, place, coverage, below, upstream.grad, curvature),
        None => 0.0,
    };
    let gradient = match &fill.axis {
        None => unblend_solid(fill, coverage, below, upstream.grad),
        Some(_) => unblend_linear(fill, place, coverage, below, upstream.grad),
    };
    FillGradient {
        importance,
        ..gradient
    }
}

fn unblend_solid(
    fill: &Fill,
    coverage: &mut [Lane],
    below: &[Rgb],
    grad: &mut [Rgb],
) -> FillGradient {
    let [colour @ .., opacity] = fill.first;
    let mut sums = [[0.0_f32; ROWS]; 4];
    for ((covered, b), g) in coverage.iter_mut().zip(below).zip(grad) {
        for l in 0..ROWS {
            let alpha = covered[l] * opacity;
            let mut by_alpha = 0.0;
            for k in 0..3 {
                by_alpha += g[k][l] * (colour[k] - b[k][l]);
                sums[k][l] += g[k][l] * alpha;
                g[k][l] -= g[k][l] * alpha;
            }
            sums[3][l] += by_alpha * covered[l];
            covered[l] = by_alpha * opacity;
        }
    }
    FillGradient {
        stops: [sums.map(total), [0.0; 4]],
        ..FillGradient::default()
    }
}

fn unblend_linear(
    fill: &Fill,
    place: Place,
    coverage: &mut [Lane],
    below: &[Rgb],
    grad: &mut [Rgb],
) -> FillGradient {
    let Some(axis) = &fill.axis else {
        return FillGradient::default();
    };
    let (mut position, step) = axis.ramp(place.top, place.column);
    let (mut sums, mut last) = ([[0.0_f32; ROWS]; 4], [[0.0_f32; ROWS]; 4]);
    let mut moments = Moments::ZERO;
    let mut x = place.column as f32 + 0.5;
    for ((covered, b), g) in coverage.iter_mut().zip(below).zip(grad) {
        for l in 0..ROWS {
            let s = position[l].clamp(0.0, 1.0);
            let opacity = fill.first[3] + s * fill.change[3];
            let alpha = covered[l] * opacity;
            let (mut by_alpha, mut by_colour) = (0.0, 0.0);
            for k in 0..3 {
                let flow = g[k][l] * alpha;
                by_alpha += g[k][l] * (fill.first[k] + s * fill.change[k] - b[k][l]);
                by_colour += flow * fill.change[k];
                sums[k][l] += flow;
                last[k][l] += flow * s;
                g[k][l] -= flow;
            }
            let by_opacity = by_alpha * covered[l];
            sums[3][l] += by_opacity;
            last[3][l] += by_opacity * s;
            let e = if s == position[l] {
                by_colour + by_opacity * fill.change[3]
            } else {
                0.0
            };
            moments.e[l] += e;
            moments.ex[l] += e * x;
            moments.es[l] += e * s;
            covered[l] = by_alpha * opacity;
            position[l] += step;
        }
        x += 1.0;
    }
    let (sums, last) = (sums.map(total), last.map(total));
    let first = std::array::from_fn(|k| sums[k] - last[k]);
    FillGradient {
        stops: [first, last],
        axis: axis.gradient(&moments, place.top),
        importance: 0.0,
    }
}

/// Exact loss increase if the path were removed: with `δ = α(B − c)`, `Σ g·δ + curvature·|δ|²`; passes the curvature on.
fn removal(
    fill: &Fill,
    place: Place,
    coverage: &[Lane],
    below: &[Rgb],
    grad: &[Rgb],
    curvature: &mut [Lane],
) -> f64 {
    let (mut position, step) = fill.axis.as_ref().map_or(([0.0; ROWS], 0.0), |axis| {
        axis.ramp(place.top, place.column)
    });
    let mut sums = [0.0_f64; ROWS];
    for (((covered, b), g), q) in coverage.iter().zip(below).zip(grad).zip(curvature) {
        for l in 0..ROWS {
            let s = position[l].clamp(0.0, 1.0);
            let alpha = covered[l] * (fill.first[3] + s * fill.change[3]);
            let (mut slope, mut square) = (0.0, 0.0);
            for k in 0..3 {
                let change = alpha * (b[k][l] - fill.first[k] - s * fill.change[k]);
                slope += g[k][l] * change;
                square += change * change;
            }
            sums[l] += f64::from(slope + q[l] * square);
            q[l] *= (1.0 - alpha) * (1.0 - alpha);
            position[l] += step;
        }
    }
    sums.iter().sum()
}

fn total(lane: Lane) -> f32 {
    lane.iter().sum()
}
