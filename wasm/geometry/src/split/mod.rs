//! Splits the curves of a path at the mesh's edges, so that every piece lies in one triangle (paper, supplement C).

pub mod crossings;
pub mod path;

pub use path::{Anchor, SplitPath, keep_path, split_path};
