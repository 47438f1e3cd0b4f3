//! Reads targets into a band, measures the loss there and yields the gradient that enters at that height of the stack.

use crate::cells::{Lane, ROWS};
use crate::composite::Rgb;
use crate::scene::{Checkpoint, Frame};

/// Gradient that joins the backward pass below path `below`, over one band.
#[derive(Debug, Default)]
pub struct Seam {
    pub below: usize,
    /// `∂loss/∂C` of this checkpoint alone.
    pub grad: Vec<Rgb>,
    /// `½·∂²loss/∂C²` of this checkpoint alone.
    pub curvature: Vec<Lane>,
}

impl Seam {
    /// Compares a band of the picture with a checkpoint's target and returns its share of the loss.
    pub fn observe(
        &mut self,
        checkpoint: &Checkpoint<'_>,
        picture: &[Rgb],
        frame: &Frame<'_>,
        top: usize,
    ) -> f64 {
        let scale = 1.0 / (3 * frame.width * frame.height) as f32;
        self.below = checkpoint.below;
        self.grad.clear();
        self.grad.resize(frame.width, [[0.0; ROWS]; 3]);
        self.curvature.clear();
        self.curvature.resize(frame.width, [0.0; ROWS]);
        read_rgb(checkpoint.target, frame, top, &mut self.grad);
        read_grey(checkpoint.weight, frame, top, &mut self.curvature);
        let mut sums = [0.0_f64; ROWS];
        for ((g, q), c) in self.grad.iter_mut().zip(&mut self.curvature).zip(picture) {
            for l in 0..ROWS {
                q[l] *= scale;
                let mut square = 0.0;
                for k in 0..3 {
                    let residual = c[k][l] - g[k][l];
                    square += residual * residual;
                    g[k][l] = 2.0 * q[l] * residual;
                }
                sums[l] += f64::from(q[l] * square);
            }
        }
        sums.iter().sum()
    }

    /// Takes a given gradient of the finished picture instead of a target.
    pub fn receive(&mut self, grad_image: &[f32], n_paths: usize, frame: &Frame<'_>, top: usize) {
        self.below = n_paths;
        self.grad.clear();
        self.grad.resize(frame.width, [[0.0; ROWS]; 3]);
        self.curvature.clear();
        self.curvature.resize(frame.width, [0.0; ROWS]);
        read_rgb(grad_image, frame, top, &mut self.grad);
    }
}

/// Columns transposed at a time: they stay in the first-level cache.
const BLOCK: usize = 16;

/// Transposes the band's rows of `image [height, width, 3]`; rows below the frame keep their values.
pub fn read_rgb(image: &[f32], frame: &Frame<'_>, top: usize, band: &mut [Rgb]) {
    let stride = 3 * frame.width;
    for (block, columns) in band.chunks_mut(BLOCK).enumerate() {
        let first = 3 * BLOCK * block;
        for (row, line) in image.chunks_exact(stride).skip(top).take(ROWS).enumerate() {
            let pixels = line[first..].as_chunks::<3>().0;
            for (column, pixel) in columns.iter_mut().zip(pixels) {
                for k in 0..3 {
                    column[k][row] = pixel[k];
                }
            }
        }
    }
}

/// Transposes the band's rows of `image [height, width]`; rows below the frame keep their values.
pub fn read_grey(image: &[f32], frame: &Frame<'_>, top: usize, band: &mut [Lane]) {
    for (block, columns) in band.chunks_mut(BLOCK).enumerate() {
        let first = BLOCK * block;
        for (row, line) in image
            .chunks_exact(frame.width)
            .skip(top)
            .take(ROWS)
            .enumerate()
        {
            for (column, value) in columns.iter_mut().zip(&line[first..]) {
                column[row] = *value;
            }
        }
    }
}

/// Transposes a band back into rows, `[height, width, 3]`, as many as `image` holds.
pub fn write_rgb(band: &[Rgb], image: &mut [f32]) {
    let stride = 3 * band.len();
    for (block, columns) in band.chunks(BLOCK).enumerate() {
        let first = 3 * BLOCK * block;
        for (row, line) in image.chunks_exact_mut(stride).enumerate() {
            let pixels = line[first..].as_chunks_mut::<3>().0;
            for (column, pixel) in columns.iter().zip(pixels) {
                for k in 0..3 {
                    pixel[k] = column[k][row];
                }
            }
        }
    }
}
