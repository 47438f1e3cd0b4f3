//! The geometry of a scene: control points, and to what each path is bound.

use crate::error::RigError;
use crate::local::Part;
use crate::mesh::grid::bounds;
use crate::mesh::vertices::Extent;
use crate::point::Point;

/// To what a path is bound.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Layer {
    Back,
    Fore,
    Local(Part),
}

impl Layer {
    /// Layer of a number as it crosses the borders: 0 back, 1 fore, 2 + n for part n of the local layer.
    ///
    /// # Errors
    /// `RigError::Scene` when there is no such layer.
    pub fn from_number(number: u8) -> Result<Self, RigError> {
        match number {
            0 => Ok(Self::Back),
            1 => Ok(Self::Fore),
            part => Ok(Self::Local(Part::from_number(part - 2)?)),
        }
    }
}

/// Geometry of a scene in painter's order: control points of all paths, one after another.
#[derive(Clone, Copy, Debug)]
pub struct SceneGeometry<'a> {
    pub width: f64,
    pub height: f64,
    pub points: &'a [Point],
    /// Cubic segments of each path.
    pub segments: &'a [usize],
    pub layers: &'a [Layer],
}

impl SceneGeometry<'_> {
    /// # Errors
    /// `RigError::Scene` when the arrays do not fit together or hold a number that is not finite.
    pub fn check(&self) -> Result<(), RigError> {
        let wanted: usize = self.segments.iter().map(|n| 3 * n).sum();
        if wanted != self.points.len() {
            let given = self.points.len();
            return Err(RigError::Scene(format!("{given} control points given, the segments need {wanted}")));
        }
        if let Some(path) = self.segments.iter().position(|&n| n == 0) {
            return Err(RigError::Scene(format!("path {path} has no segments; a path needs one at least")));
        }
        if self.layers.len() != self.segments.len() {
            let (segments, layers) = (self.segments.len(), self.layers.len());
            return Err(RigError::Scene(format!("{segments} paths have segments, {layers} have a layer")));
        }
        let size = Point::new(self.width, self.height);
        if !(size.is_finite() && size.x > 0.0 && size.y > 0.0) {
            return Err(RigError::Scene(format!("the picture measures {} x {}", size.x, size.y)));
        }
        match self.points.iter().position(|point| !point.is_finite()) {
            Some(index) => Err(RigError::Scene(format!("control point {index} is not a finite point"))),
            None => Ok(()),
        }
    }

    /// Layer and control points of every path; `check` has passed.
    pub fn paths(&self) -> impl Iterator<Item = (Layer, &[Point])> {
        let ends = self.segments.iter().scan(0, |end, n_segments| {
            *end += 3 * n_segments;
            Some(*end)
        });
        ends.zip(self.segments).zip(self.layers).map(|((end, n), &layer)| (layer, &self.points[end - 3 * n..end]))
    }

    /// What the mesh has to cover: the picture, and control points beyond it.
    #[must_use]
    pub fn extent(&self) -> Extent {
        let frame = [Point::ZERO, Point::new(self.width, self.height)];
        let corners: Vec<Point> = self.points.iter().copied().chain(frame).collect();
        let (lowest, highest) = bounds(&corners);
        Extent { width: self.width, height: self.height, lowest, highest }
    }
}
