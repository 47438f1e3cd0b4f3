//! Properties of whole rigs: topology, splitting, binding, poses.
#![allow(clippy::unwrap_used, reason = "a rig that cannot be built fails the test")]

mod degenerate;
mod features;
mod mesh;
mod scenes;
mod warp;
