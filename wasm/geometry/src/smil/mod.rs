//! Turns a moving picture into one animated SVG that needs no script, so that it plays in an `<img>` too.
//!
//! * Every outline is animated on `d` by keyframes that linear interpolation carries to all frames within a stated
//!   tolerance; as a warp is linear in the landmarks, few are needed.
//! * Coordinates are whole steps of a fraction of that tolerance, written relative (`m`, `c`, `z` everywhere: `d` is
//!   only interpolated between equal command lists). Keyframes are differences from the first frame, `additive="sum"`:
//!   neighbouring points move alike, so most numbers are one digit.
//! * The head's shift and turn are factored out. Browsers ignore `type="matrix"`, so it is an `<animateTransform>` each
//!   for `translate` and `rotate` on a group. A path is written in whichever frame of reference, the picture's or the
//!   head's, makes the file smaller. So it is with the shift and turn of single paths: a key of theirs costs three
//!   numbers, one of `d` some hundred and fifty.

mod document;
mod elements;
mod keyframes;
mod path_data;
mod picture;
mod reference;
mod rigged;
mod rigid;
#[cfg(test)]
mod round_trip;

pub use document::write;
pub use picture::{Fill, Motion, Picture, Stop};
pub use rigged::RiggedMotion;

/// How an animated SVG is written.
#[derive(Clone, Copy, Debug)]
pub struct Options<'a> {
    /// Seconds from the first frame to the last.
    pub duration: f64,
    /// Largest distance of a control point from where its frame has it, in portrait pixels.
    pub tolerance: f64,
    /// Start again at the end; otherwise the last frame stays.
    pub looped: bool,
    pub title: &'a str,
    pub description: &'a str,
}

impl Options<'_> {
    /// Whether duration and tolerance are finite and above zero.
    #[must_use]
    pub fn is_sound(&self) -> bool {
        [self.duration, self.tolerance].iter().all(|value| value.is_finite() && *value > 0.0)
    }
}
