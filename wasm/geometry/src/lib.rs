//! Turns a scene and its rest landmarks into a rig, and a pose of that rig into warped control points and path strings.

pub mod cubic;
pub mod opening;
pub mod point;
