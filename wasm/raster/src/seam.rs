//! Reads targets into a band, measures the loss there and yields the gradient that enters at that height of the stack.

use crate::scene::{Checkpoint, Frame};
use crate::shade::Rgb;
use crate::transpose::read;
use crate::walk::{Lane, ROWS};

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
    pub fn observe(&mut self, checkpoint: &Checkpoint<'_>, picture: &[Rgb], frame: &Frame<'_>, top: usize) -> f64 {
        let scale = 1.0 / (3 * frame.width * frame.height) as f32;
        self.below = checkpoint.below;
        self.clear(frame.width);
        read(checkpoint.target, 3 * frame.width, top, 0, self.grad.as_flattened_mut());
        read(checkpoint.weight, frame.width, top, 0, &mut self.curvature);
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
        self.clear(frame.width);
        read(grad_image, 3 * frame.width, top, 0, self.grad.as_flattened_mut());
    }

    fn clear(&mut self, width: usize) {
        self.grad.clear();
        self.grad.resize(width, [[0.0; ROWS]; 3]);
        self.curvature.clear();
        self.curvature.resize(width, [0.0; ROWS]);
    }

    /// Adds this checkpoint's gradient and curvature to what comes down from above.
    pub fn join(&self, grad: &mut [Rgb], curvature: &mut [Lane]) {
        for (g, joining) in grad.as_flattened_mut().iter_mut().zip(self.grad.as_flattened()) {
            for l in 0..ROWS {
                g[l] += joining[l];
            }
        }
        for (q, joining) in curvature.iter_mut().zip(&self.curvature) {
            for l in 0..ROWS {
                q[l] += joining[l];
            }
        }
    }
}
