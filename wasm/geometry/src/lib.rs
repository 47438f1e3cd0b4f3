//! Turns a scene and its rest landmarks into a rig, and a pose of that rig into warped control points and path strings.

pub mod binding;
pub mod bound;
pub mod cubic;
pub mod error;
pub mod face;
pub mod fit;
pub mod gradient;
pub mod joints;
pub mod local;
pub mod mesh;
pub mod opening;
pub mod path_string;
pub mod point;
pub mod polygon;
pub mod pose;
pub mod rig;
pub mod scene;
pub mod smil;
pub mod sockets;
pub mod split;
