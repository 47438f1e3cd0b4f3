//! A chord as a band sees it: from left to right, y in sub-rows below the band's top.

use crate::flatten::Chords;
use crate::lane::{ROWS, cut, least, most};

/// Vertical extent of a band and the frame's width.
#[derive(Debug, Clone, Copy)]
pub struct Window {
    /// First pixel row.
    pub top: usize,
    pub width: usize,
    /// Sub-rows of a pixel.
    pub subrows: usize,
}

/// A chord between its left end at (`x`, `y`) and its right end `dx ≥ 0` further, at height `end`.
#[derive(Debug, Clone, Copy)]
pub struct Line {
    pub x: f32,
    pub y: f32,
    pub dx: f32,
    pub end: f32,
    /// The chord runs from left to right.
    pub along: bool,
}

impl Line {
    /// The chord from a vertex to the next one.
    #[inline(always)]
    pub fn new(chords: &Chords, vertex: usize, window: Window) -> Self {
        let (scale, top) = (window.subrows as f32, window.top as f32);
        let [from, to] = [vertex, vertex + 1].map(|v| (chords.x[v], (chords.y[v] - top) * scale));
        let along = to.0 >= from.0;
        let (left, right) = if along { (from, to) } else { (to, from) };
        Self { x: left.0, y: left.1, dx: right.0 - left.0, end: right.1, along }
    }

    #[inline(always)]
    pub fn low(&self) -> f32 {
        least(self.y, self.end)
    }

    #[inline(always)]
    pub fn high(&self) -> f32 {
        most(self.y, self.end)
    }

    /// Least and greatest x of the part inside a band, if there is one; a horizontal line belongs to the row below it.
    #[inline(always)]
    pub fn extent(&self, window: Window) -> Option<(f32, f32)> {
        let (low, high, bottom) = (self.low(), self.high(), (ROWS * window.subrows) as f32);
        if low >= bottom || high < 0.0 || (high == 0.0 && low < high) || (self.dx == 0.0 && low == high) {
            return None;
        }
        if low == high {
            return Some((self.x, self.x + self.dx));
        }
        let slope = self.dx / (self.end - self.y);
        let x = |y: f32| self.x + (cut(y, 0.0, bottom) - self.y) * slope;
        Some((x(self.y), x(self.end)))
    }
}
