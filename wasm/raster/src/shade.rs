//! Colour and opacity of a fill, lane by lane.

use crate::fill::Fill;
use crate::walk::{Lane, ROWS};

/// One column of colours, channel by channel.
pub type Rgb = [Lane; 3];

/// First row and column of a tile in the frame.
#[derive(Debug, Clone, Copy)]
pub struct Place {
    pub top: usize,
    pub column: usize,
}

/// A fill that walks along with a tile's columns; `LINEAR` lets the compiler drop the gradient from solid fills.
#[derive(Debug)]
pub struct Shade<const LINEAR: bool> {
    first: [f32; 4],
    change: [f32; 4],
    /// Unpadded positions along the axis.
    position: Lane,
    step: f32,
}

impl<const LINEAR: bool> Shade<LINEAR> {
    /// The fill at a tile's first column.
    pub fn new(fill: &Fill, place: Place) -> Self {
        let still = ([0.0; ROWS], 0.0);
        let (position, step) = fill.axis.as_ref().map_or(still, |axis| axis.ramp(place.top, place.column));
        Self { first: fill.first, change: fill.change, position, step }
    }

    /// Padded position of row `l` of this column.
    #[inline(always)]
    pub fn position(&self, l: usize) -> f32 {
        if LINEAR { self.position[l].clamp(0.0, 1.0) } else { 0.0 }
    }

    /// Whether the position of row `l` moves with the axis.
    #[inline(always)]
    pub fn is_within(&self, l: usize) -> bool {
        (0.0..=1.0).contains(&self.position[l])
    }

    /// Channel `k` (3: opacity) at a padded position.
    #[inline(always)]
    pub fn channel(&self, k: usize, position: f32) -> f32 {
        if LINEAR { self.first[k] + position * self.change[k] } else { self.first[k] }
    }

    /// Change of channel `k` from the first stop to the last.
    #[inline(always)]
    pub fn change(&self, k: usize) -> f32 {
        self.change[k]
    }

    /// Goes on to the next column.
    #[inline(always)]
    pub fn advance(&mut self) {
        if LINEAR {
            for l in 0..ROWS {
                self.position[l] += self.step;
            }
        }
    }
}
