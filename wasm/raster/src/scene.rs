//! Checks flat arrays once and names them: paths in painter's order and the frame that they are painted on.

use crate::error::Error;
use crate::fill::STOPS;
use crate::target::Target;
use std::ops::Range;

/// Longest side of a frame, as of a portrait; an f32 coordinate is still exact to 1/4096 px there.
pub const MAX_SIDE: usize = 4096;
/// Most paths of a call: twice what a scene may hold. All cells of a band of so many full-width tiles have `u32` indices.
pub const MAX_PATHS: usize = 8192;
/// Most cubic segments of a path.
pub const MAX_SEGMENTS: usize = 1024;
/// Farthest control point, in pixels from the origin.
pub const MAX_COORDINATE: f32 = 65536.0;
/// Finest flattening, in pixels.
pub const LEAST_FLATNESS: f32 = 1e-3;
/// Largest colour, opacity, weight or target; keeps every sum finite in f32.
pub const MAX_COLOUR: f32 = 1e6;

/// Closed chains of cubics in painter's order (bottom first), coordinates in pixels of the frame.
#[derive(Debug, Clone, Copy)]
pub struct Paths<'a> {
    /// Cubic segments of every path, `S`.
    pub segments: usize,
    /// Control points, `[n, 3S, 2]`: anchor, handle, handle, anchor, …
    pub points: &'a [f32],
    /// Stops of unpremultiplied sRGB and opacity at the start, middle and end of the axis, `[n, 3, 4]`; a solid fill uses the first.
    pub stops: &'a [f32],
    /// Gradient axis from the first stop to the last, `[n, 4]`: x1, y1, x2, y2.
    pub axis: &'a [f32],
    /// Whether the fill is a linear gradient, `[n]`.
    pub gradient: &'a [bool],
    /// Index of the clip mask, or -1, `[n]`.
    pub clip: &'a [i32],
}

/// The picture's size, its background and how coverage is resolved.
#[derive(Debug, Clone, Copy)]
pub struct Frame<'a> {
    pub width: usize,
    pub height: usize,
    /// sRGB of the background.
    pub canvas: [f32; 3],
    /// Clip masks multiplying opacity, `[k, height, width]`.
    pub clips: &'a [f32],
    /// Sub-rows of a pixel (1, 2 or 4) over which `|winding|` saturates: more is closer to the nonzero rule where paths fold.
    pub subrows: usize,
    /// Farthest that a chord may stray from its cubic, in pixels; what the fineness of outlines costs is time.
    pub flatness: f32,
    /// Round to 8 bits after every blend, as renderers do; gradients pass straight through.
    pub quantise: bool,
}

/// A target for the picture made of the lowest `below` paths.
#[derive(Debug, Clone, Copy)]
pub struct Checkpoint<'a> {
    pub below: usize,
    pub target: &'a Target,
}

/// Where the gradient of the picture comes from.
#[derive(Debug, Clone, Copy)]
pub enum Objective<'a> {
    /// Sum over checkpoints of `Σ weight·|C − target|² / (3·height·width)`.
    Checkpoints(&'a [Checkpoint<'a>]),
    /// The gradient of some other loss with respect to the finished picture, `[height, width, 3]`.
    Upstream(&'a [f32]),
}

/// Bands `first`, `first + every`, … of 16 rows stand for all: what is summed over pixels is `every` times their sum.
///
/// Over `every` calls with another `first` each, losses and gradients are those of the whole on the mean.
#[derive(Debug, Clone, Copy)]
pub struct Sample {
    pub every: usize,
    pub first: usize,
}

impl Default for Sample {
    fn default() -> Self {
        Self { every: 1, first: 0 }
    }
}

impl Sample {
    /// Refuses a sample that may be empty.
    pub fn check(&self) -> Result<(), Error> {
        size("bands taken", self.every, 1, MAX_SIDE)?;
        size("first of the bands taken", self.first, 0, self.every - 1)
    }
}

impl<'a> Paths<'a> {
    /// Number of paths, `n`.
    pub fn len(&self) -> usize {
        self.gradient.len()
    }

    pub fn is_empty(&self) -> bool {
        self.gradient.is_empty()
    }

    /// Some of the paths, one after the other.
    pub fn slice(&self, part: Range<usize>) -> Self {
        let of = |values: &'a [f32], stride: usize| &values[part.start * stride..part.end * stride];
        Self {
            segments: self.segments,
            points: of(self.points, self.segments * 6),
            stops: of(self.stops, 4 * STOPS),
            axis: of(self.axis, 4),
            gradient: &self.gradient[part.clone()],
            clip: &self.clip[part.clone()],
        }
    }

    /// Refuses arrays of wrong length, values that are not finite and counts beyond the limits.
    pub fn check(&self, frame: &Frame<'_>) -> Result<(), Error> {
        let n = self.len();
        size("number of paths", n, 0, MAX_PATHS)?;
        size("segments of a path", self.segments, 1, MAX_SEGMENTS)?;
        length("points", self.points, n * self.segments * 6)?;
        length("stops", self.stops, n * 4 * STOPS)?;
        length("axis", self.axis, n * 4)?;
        if self.clip.len() != n {
            return Err(Error::Length { name: "clip", got: self.clip.len(), expected: n });
        }
        within("points", self.points, MAX_COORDINATE)?;
        within("stops", self.stops, MAX_COLOUR)?;
        within("axis", self.axis, MAX_COORDINATE)?;
        let masks = frame.clips.len() / (frame.width * frame.height);
        match self.clip.iter().find(|&&c| c < -1 || c >= masks as i32) {
            Some(&got) => Err(Error::Clip { got, masks }),
            None => Ok(()),
        }
    }
}

impl Frame<'_> {
    /// Refuses sizes beyond the limits and masks that do not fit the frame.
    pub fn check(&self) -> Result<(), Error> {
        size("width", self.width, 1, MAX_SIDE)?;
        size("height", self.height, 1, MAX_SIDE)?;
        if ![1, 2, 4].contains(&self.subrows) {
            return Err(Error::Size { name: "subrows (1, 2 or 4)", got: self.subrows, least: 1, most: 4 });
        }
        let pixels = self.width * self.height;
        length("clips", self.clips, self.clips.len().div_ceil(pixels) * pixels)?;
        if !(LEAST_FLATNESS..=1.0).contains(&self.flatness) {
            return Err(Error::Value { name: "flatness", got: self.flatness, limit: 1.0 });
        }
        within("canvas", &self.canvas, MAX_COLOUR)
    }

    /// Refuses masks whose values are not finite or beyond the limit.
    pub fn check_clips(&self) -> Result<(), Error> {
        within("clips", self.clips, MAX_COLOUR)
    }
}

impl Objective<'_> {
    /// One a checkpoint.
    pub fn n_losses(&self) -> usize {
        match self {
            Self::Checkpoints(checkpoints) => checkpoints.len(),
            Self::Upstream(_) => 0,
        }
    }

    /// Refuses targets that do not fit the frame, checkpoints out of order and gradients that are not finite.
    pub fn check(&self, n_paths: usize, frame: &Frame<'_>) -> Result<(), Error> {
        let pixels = frame.width * frame.height;
        let checkpoints = match self {
            Self::Upstream(grad) => {
                length("grad_image", grad, pixels * 3)?;
                return within("grad_image", grad, MAX_COLOUR);
            }
            Self::Checkpoints(checkpoints) => checkpoints.iter(),
        };
        check_heights(checkpoints.clone().map(|checkpoint| checkpoint.below), n_paths)?;
        for checkpoint in checkpoints {
            size("width of a target", checkpoint.target.width, frame.width, frame.width)?;
            size("height of a target", checkpoint.target.height, frame.height, frame.height)?;
        }
        Ok(())
    }
}

/// Refuses numbers of lowest paths that do not ascend, or are more than there are.
pub fn check_heights(heights: impl Iterator<Item = usize>, n_paths: usize) -> Result<(), Error> {
    let mut after = 0;
    for got in heights {
        if got < after || got > n_paths {
            return Err(Error::Order { got, after });
        }
        after = got;
    }
    Ok(())
}

pub fn size(name: &'static str, got: usize, least: usize, most: usize) -> Result<(), Error> {
    if (least..=most).contains(&got) { Ok(()) } else { Err(Error::Size { name, got, least, most }) }
}

pub fn length(name: &'static str, values: &[f32], expected: usize) -> Result<(), Error> {
    if values.len() == expected { Ok(()) } else { Err(Error::Length { name, got: values.len(), expected }) }
}

pub fn within(name: &'static str, values: &[f32], limit: f32) -> Result<(), Error> {
    // A reduction without early exit is vectorised; NaN fails the comparison and is found by the search below.
    let fine = values.iter().fold(true, |fine, v| fine & (v.abs() <= limit));
    if fine {
        return Ok(());
    }
    let got = values.iter().copied().find(|v| v.is_nan() || v.abs() > limit).unwrap_or(f32::NAN);
    Err(Error::Value { name, got, limit })
}
