//! Turns a pose (articulators and landmark offsets) into vertex positions.

pub mod channel;
pub mod clamp;
pub mod eyes;
pub mod head;
pub mod mouth;

pub use channel::{Channel, N_CHANNELS, Pose};
