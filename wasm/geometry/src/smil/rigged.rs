//! The motion of a rigged scene whose vertices are known in every frame.

use super::picture::Motion;
use crate::gradient::follow_path;
use crate::opening::Opening;
use crate::point::Point;
use crate::rig::Rig;

/// Landmarks on the skull: jaw joints, bridge of the nose, corners of the eyes.
const SKULL: [usize; 7] = [0, 16, 27, 36, 39, 42, 45];

/// A rig posed frame by frame. Only vertices are kept; points are computed path by path, as a minute of them would not
/// fit into a browser's memory.
#[derive(Clone, Debug)]
pub struct RiggedMotion<'a> {
    rig: &'a Rig,
    /// Positions of all vertices, frame by frame.
    vertices: Vec<Vec<Point>>,
    displacements: Vec<Vec<Point>>,
    /// Ends of each path's gradient at rest; those of solid paths are not read.
    axes: Vec<[Point; 2]>,
}

impl<'a> RiggedMotion<'a> {
    /// `vertices` are `n` frames of all the rig's vertices, one after another; `axes` has two points a path. None when
    /// they do not fit the rig, hold a number that is not finite, or there is no frame.
    #[must_use]
    pub fn new(rig: &'a Rig, vertices: &[Point], axes: &[Point]) -> Option<Self> {
        let rest = rig.rest_vertices();
        let finite = vertices.iter().chain(axes).all(|p| p.is_finite());
        let whole = !vertices.is_empty() && vertices.len().is_multiple_of(rest.len());
        if !finite || !whole || axes.len() != 2 * rig.paths().n_paths() {
            return None;
        }
        let vertices: Vec<Vec<Point>> = vertices.chunks(rest.len()).map(<[Point]>::to_vec).collect();
        let displaced = |frame: &Vec<Point>| frame.iter().zip(rest).map(|(&now, &then)| now - then).collect();
        let displacements = vertices.iter().map(displaced).collect();
        let axes = axes.chunks(2).map(|ends| [ends[0], ends[1]]).collect();
        Some(Self { rig, vertices, displacements, axes })
    }
}

impl Motion for RiggedMotion<'_> {
    fn n_frames(&self) -> usize {
        self.vertices.len()
    }

    fn path(&self, path: usize, frame: usize) -> Vec<Point> {
        self.rig.paths().warped_path(path, &self.displacements[frame])
    }

    fn opening(&self, opening: usize, frame: usize) -> Vec<Point> {
        Opening::ALL[opening].outline(&self.vertices[frame])
    }

    fn axis(&self, path: usize, frame: usize) -> [Point; 2] {
        follow_path(self.axes[path], self.rig.paths().rest_path(path), &self.path(path, frame))
    }

    fn head(&self, frame: usize) -> Vec<Point> {
        SKULL.map(|landmark| self.vertices[frame][landmark]).to_vec()
    }
}
