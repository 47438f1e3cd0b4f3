//! Turns a target picture and its weights into lanes, once for all passes that compare with it.

use crate::error::Error;
use crate::lane::{Lane, ROWS, ZERO};
use crate::scene::{MAX_COLOUR, MAX_SIDE, length, size, within};
use crate::transpose;
use std::ops::Range;

/// sRGB and weight of every pixel of a picture, band by band.
#[derive(Debug, Clone)]
pub struct Target {
    pub width: usize,
    pub height: usize,
    bands: Vec<BandTarget>,
}

/// The columns of a band from the first to the last that have any weight.
#[derive(Debug, Clone)]
pub struct BandTarget {
    pub columns: Range<usize>,
    /// sRGB and weight / 3HW.
    pub pixels: Vec<[Lane; 4]>,
}

impl Target {
    /// Reads sRGB `target [height, width, 3]` and the squared error's `weight [height, width]`.
    pub fn new(target: &[f32], weight: &[f32], width: usize, height: usize) -> Result<Self, Error> {
        size("width", width, 1, MAX_SIDE)?;
        size("height", height, 1, MAX_SIDE)?;
        length("target", target, 3 * width * height)?;
        length("weight", weight, width * height)?;
        within("target", target, MAX_COLOUR)?;
        within("weight", weight, MAX_COLOUR)?;
        let bands =
            (0..height).step_by(ROWS).map(|top| BandTarget::new(target, weight, (width, height), top)).collect();
        Ok(Self { width, height, bands })
    }

    /// The band at row `top`.
    pub fn band(&self, top: usize) -> &BandTarget {
        &self.bands[top / ROWS]
    }
}

impl BandTarget {
    fn new(target: &[f32], weight: &[f32], (width, height): (usize, usize), top: usize) -> Self {
        let scale = 1.0 / (3 * width * height) as f32;
        let mut weights = vec![ZERO; width];
        transpose::read(weight, width, top, 0, &mut weights);
        let counts = |lane: &Lane| *lane != ZERO;
        let first = weights.iter().position(counts).unwrap_or(0);
        let last = weights.iter().rposition(counts).map_or(0, |i| i + 1);
        let mut colours = vec![ZERO; 3 * (last - first)];
        transpose::read(target, 3 * width, top, 3 * first, &mut colours);
        let columns = colours.as_chunks::<3>().0.iter().zip(&weights[first..last]);
        let pixels = columns.map(|(&[r, g, b], &weight)| [r, g, b, weight * scale]).collect();
        Self { columns: first..last, pixels }
    }
}
