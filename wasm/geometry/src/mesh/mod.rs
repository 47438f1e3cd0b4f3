//! The triangle mesh over a resting face: its vertices, its triangles, and where a point lies in it.

pub mod grid;
pub mod triangles;
pub mod vertices;

pub use triangles::{Mesh, Triangle};
pub use vertices::VertexSet;
