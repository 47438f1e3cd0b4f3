//! What can be wrong with a call, each message naming the value and the limit.

use std::fmt;

/// A refused input of the rasteriser.
#[derive(Debug, Clone, PartialEq)]
pub enum Error {
    /// An array holds another number of values than its shape asks for.
    Length { name: &'static str, got: usize, expected: usize },
    /// A count or size lies outside its limits.
    Size { name: &'static str, got: usize, least: usize, most: usize },
    /// A number is not finite, or too large for f32 arithmetic to stay exact to a hundredth of a pixel.
    Value { name: &'static str, got: f32, limit: f32 },
    /// A path names a clip mask that does not exist.
    Clip { got: i32, masks: usize },
    /// Checkpoints must count paths in ascending order.
    Order { got: usize, after: usize },
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Length { name, got, expected } => {
                write!(f, "{name} holds {got} values; its shape asks for {expected}.")
            }
            Self::Size { name, got, least, most } => write!(f, "{name} is {got}; the limits are {least} to {most}."),
            Self::Value { name, got, limit } => {
                write!(f, "{name} holds {got}; values must be finite and within ±{limit}.")
            }
            Self::Clip { got, masks } => write!(f, "clip names mask {got}; there are {masks} (-1 means none)."),
            Self::Order { got, after } => {
                write!(
                    f,
                    "checkpoint counts {got} paths after one of {after}; counts must ascend up to the number of paths."
                )
            }
        }
    }
}

impl std::error::Error for Error {}
