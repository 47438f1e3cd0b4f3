//! Reads targets into a band, measures the loss there and yields the gradient that enters at that height of the stack.

use crate::scene::{Checkpoint, Frame};
use crate::shade::Rgb;
use crate::transpose::read;
use crate::walk::{Lane, ROWS};
use std::ops::Range;

/// Gradient that joins the backward pass below path `below`, over the columns of one band that have any weight.
#[derive(Debug, Default)]
pub struct Seam {
    pub below: usize,
    /// Columns of the frame; the lowest to the highest with a weight.
    active: Range<usize>,
    /// `∂loss/∂C` of this checkpoint alone, over the active columns.
    grad: Vec<Rgb>,
    /// `½·∂²loss/∂C²` of this checkpoint alone, over all columns.
    curvature: Vec<Lane>,
}

impl Seam {
    /// Compares a band of the picture with a checkpoint's target and returns its share of the loss.
    pub fn observe(&mut self, checkpoint: &Checkpoint<'_>, picture: &[Rgb], frame: &Frame<'_>, top: usize) -> f64 {
        let scale = 1.0 / (3 * frame.width * frame.height) as f32;
        self.below = checkpoint.below;
        self.weigh(checkpoint.weight, frame.width, top);
        self.read_grad(checkpoint.target, frame.width, top);
        let (picture, curvature) = (&picture[self.active.clone()], &mut self.curvature[self.active.clone()]);
        let mut sums = [0.0_f64; ROWS];
        for ((g, q), c) in self.grad.iter_mut().zip(curvature).zip(picture) {
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
        self.active = 0..frame.width;
        self.curvature.clear();
        self.curvature.resize(frame.width, [0.0; ROWS]);
        self.read_grad(grad_image, frame.width, top);
    }

    /// Reads a band of weights and finds the columns that have any.
    fn weigh(&mut self, weight: &[f32], width: usize, top: usize) {
        self.curvature.clear();
        self.curvature.resize(width, [0.0; ROWS]);
        read(weight, width, top, 0, &mut self.curvature);
        let counts = |lane: &Lane| lane.iter().fold(false, |any, &w| any | (w != 0.0));
        let first = self.curvature.iter().position(counts).unwrap_or(0);
        let last = self.curvature.iter().rposition(counts).map_or(0, |i| i + 1);
        self.active = first..last;
    }

    fn read_grad(&mut self, image: &[f32], width: usize, top: usize) {
        self.grad.clear();
        self.grad.resize(self.active.len(), [[0.0; ROWS]; 3]);
        read(image, 3 * width, top, 3 * self.active.start, self.grad.as_flattened_mut());
    }

    /// Adds this checkpoint's gradient and curvature to what comes down from above.
    pub fn join(&self, grad: &mut [Rgb], curvature: &mut [Lane]) {
        let grad = grad[self.active.clone()].as_flattened_mut();
        for (g, joining) in grad.iter_mut().zip(self.grad.as_flattened()) {
            for l in 0..ROWS {
                g[l] += joining[l];
            }
        }
        let joining = &self.curvature[self.active.clone()];
        for (q, joining) in curvature[self.active.clone()].iter_mut().zip(joining) {
            for l in 0..ROWS {
                q[l] += joining[l];
            }
        }
    }
}
