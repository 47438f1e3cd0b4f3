//! What is written: a picture that stays the same, and the motion of its outlines.

use std::ops::Range;

use crate::opening::Opening;
use crate::point::Point;

/// Colour (sRGB bytes) and opacity (0…1) at a stop of a gradient, or of a whole fill.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stop {
    pub colour: [u8; 3],
    pub opacity: f64,
}

/// Paint of a path. The ends of a gradient move, so they are part of the motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fill {
    Solid(Stop),
    /// Stops at the start, middle and end.
    Linear([Stop; 3]),
}

/// Paths in painter's order: `n_back` that never move, `n_fore`, and the local ones, each clipped by an opening.
#[derive(Clone, Debug)]
pub struct Picture {
    pub width: f64,
    pub height: f64,
    pub canvas: [u8; 3],
    pub n_back: usize,
    pub n_fore: usize,
    pub fills: Vec<Fill>,
    /// Opening (0…2, in the order of `Opening::ALL`) of each local path.
    pub openings: Vec<usize>,
}

impl Fill {
    /// Fills of flat numbers, 13 a path: 0 solid or 1 linear, then red, green, blue (0…255) and opacity (0…1) of
    /// three stops. A solid fill is its first stop.
    #[must_use]
    pub fn from_flat(flat: &[f64]) -> Vec<Self> {
        let stop = |c: &[f64]| Stop { colour: [c[0] as u8, c[1] as u8, c[2] as u8], opacity: c[3] };
        flat.chunks_exact(13)
            .map(|row| {
                if row[0] == 0.0 {
                    Self::Solid(stop(&row[1..5]))
                } else {
                    Self::Linear([1, 5, 9].map(|start| stop(&row[start..])))
                }
            })
            .collect()
    }
}

impl Picture {
    /// Whether every path has a fill, every local one an opening, and the picture a size.
    #[must_use]
    pub fn is_whole(&self) -> bool {
        self.fills.len() == self.n_back + self.n_fore + self.openings.len()
            && self.openings.iter().all(|&opening| opening < Opening::ALL.len())
            && self.width > 0.0
            && self.height > 0.0
    }

    pub(super) fn back(&self) -> Range<usize> {
        0..self.n_back
    }

    pub(super) fn fore(&self) -> Range<usize> {
        self.n_back..self.n_back + self.n_fore
    }

    /// Runs of local paths that one opening clips.
    pub(super) fn clipped(&self) -> Vec<(usize, Range<usize>)> {
        let mut first = self.n_back + self.n_fore;
        self.openings
            .chunk_by(|a, b| a == b)
            .map(|run| {
                let paths = first..first + run.len();
                first = paths.end;
                (run[0], paths)
            })
            .collect()
    }
}

/// Where everything is in each of `n_frames` frames, evenly spaced from the start to the end of the animation.
///
/// A path or opening has the same number of points in all frames: a closed chain of cubics, `anchor, handle, handle`.
pub trait Motion {
    fn n_frames(&self) -> usize;
    fn path(&self, path: usize, frame: usize) -> Vec<Point>;
    fn opening(&self, opening: usize, frame: usize) -> Vec<Point>;
    /// Ends of the gradient of `path`.
    fn axis(&self, path: usize, frame: usize) -> [Point; 2];
    /// Points of the face that move with the skull and little else, at least two.
    fn head(&self, frame: usize) -> Vec<Point>;
}
