//! Measures the loss at some height of the stack and yields the gradient that enters there.

use crate::lane::{Lane, Rgb, ZERO, refill, reserve};
use crate::target::BandTarget;
use crate::transpose;
use std::ops::Range;

/// Gradient that joins the backward pass below path `below`, over some columns of one band.
#[derive(Debug, Default)]
pub struct Seam {
    pub below: usize,
    columns: Range<usize>,
    grad: Vec<Rgb>,
}

impl Seam {
    /// Compares a band of the picture of the paths below `below` with a target and returns its share of the loss.
    pub fn observe(&mut self, below: usize, target: &BandTarget, picture: &[Rgb]) -> f64 {
        self.below = below;
        self.columns = target.columns.clone();
        reserve(&mut self.grad, self.columns.len(), [ZERO; 3]);
        let mut sum = ZERO;
        for ((g, target), c) in self.grad.iter_mut().zip(&target.pixels).zip(&picture[self.columns.clone()]) {
            let twice = target[3] + target[3];
            for k in 0..3 {
                let residual = c[k] - target[k];
                g[k] = twice * residual;
                sum = g[k].mul_add(residual, sum);
            }
        }
        0.5 * sum.to_array().into_iter().map(f64::from).sum::<f64>()
    }

    /// Takes a given gradient of the finished picture, `[height, width, 3]`, instead.
    pub fn receive(&mut self, grad_image: &[f32], below: usize, width: usize, top: usize) {
        self.below = below;
        self.columns = 0..width;
        refill(&mut self.grad, width, [ZERO; 3]);
        transpose::read(grad_image, 3 * width, top, 0, self.grad.as_flattened_mut());
    }

    /// Adds this height's gradient to what comes down from above.
    pub fn join(&self, grad: &mut [Rgb]) {
        let grad = grad[self.columns.clone()].as_flattened_mut();
        for (g, joining) in grad.iter_mut().zip(self.grad.as_flattened()) {
            *g += *joining;
        }
    }
}

/// Adds a target's `½·∂²loss/∂C²`, which is its weight, to what comes down from above.
pub fn join_curvature(target: &BandTarget, curvature: &mut [Lane]) {
    for (q, pixel) in curvature[target.columns.clone()].iter_mut().zip(&target.pixels) {
        *q += pixel[3];
    }
}
