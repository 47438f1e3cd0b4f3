//! Measures a face: its axes, sizes and neck, in which all movements and ring vertices are given.

use crate::error::RigError;
use crate::opening::N_LANDMARKS;
use crate::point::Point;

/// Landmarks of a face, iBUG-68 order.
pub type Landmarks = [Point; N_LANDMARKS];

/// An iris or pupil disc.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Iris {
    pub centre: Point,
    pub radius: f64,
}

/// Axes and sizes of a resting face, in portrait pixels.
#[derive(Clone, Debug)]
pub struct Face {
    /// Midpoint of the outer eye corners, origin of face coordinates.
    pub origin: Point,
    /// Unit vector from image-left to image-right eye.
    pub right: Point,
    /// Unit vector from the eyes to the chin, perpendicular to `right`.
    pub down: Point,
    /// |36 − 45|, the unit of pose offsets and depths.
    pub eye_distance: f64,
    /// |48 − 54|.
    pub mouth_width: f64,
    /// Between the ears, along `right`.
    pub width: f64,
    /// Brows to chin, along `down`.
    pub height: f64,
    /// Base of the neck, about which the head turns.
    pub pivot: Point,
    /// Height of the joint between skull and spine, about which it nods: between the ear lobes.
    pub skull_joint: Point,
}

impl Face {
    /// # Errors
    /// `RigError::Landmarks` when a point is not finite or the eyes or mouth corners coincide.
    pub fn measure(landmarks: &Landmarks) -> Result<Self, RigError> {
        if let Some(index) = landmarks.iter().position(|point| !point.is_finite()) {
            return Err(RigError::Landmarks(format!("landmark {index} is not a finite point")));
        }
        let eyes = landmarks[45] - landmarks[36];
        let eye_distance = eyes.norm();
        let mouth_width = landmarks[48].distance(landmarks[54]);
        if eye_distance < MIN_SIZE || mouth_width < MIN_SIZE {
            return Err(RigError::Landmarks(format!(
                "outer eye corners are {eye_distance:.2} px and mouth corners {mouth_width:.2} px apart; \
                 a rig needs at least {MIN_SIZE} px"
            )));
        }
        let right = eyes * (1.0 / eye_distance);
        let down = Point::new(-right.y, right.x);
        let brow = landmarks[19].lerp(landmarks[24], 0.5);
        // A face seen from the side is narrower than its eyes are wide apart: keep the rings from collapsing.
        let width = (landmarks[16] - landmarks[0]).dot(right).max(1.2 * eye_distance);
        let height = (landmarks[8] - brow).dot(down).max(0.9 * eye_distance);
        Ok(Self {
            origin: landmarks[36].lerp(landmarks[45], 0.5),
            right,
            down,
            eye_distance,
            mouth_width,
            width,
            height,
            pivot: landmarks[8] + down * (NECK * height),
            skull_joint: landmarks[2].lerp(landmarks[14], 0.5),
        })
    }

    /// Vector with components along `right` and `down`.
    #[must_use]
    pub fn vector(&self, right: f64, down: f64) -> Point {
        self.right * right + self.down * down
    }
}

/// Faces smaller than this carry no pose; also keeps the triangulation's arithmetic in range.
const MIN_SIZE: f64 = 1e-3;

/// Distance of the neck's base below the chin, in brow-to-chin heights.
const NECK: f64 = 0.55;

/// Irises as given, else the middle of each eye with a radius of a quarter eye width.
#[must_use]
pub fn irises_or_eye_centres(landmarks: &Landmarks, irises: Option<[Iris; 2]>) -> [Iris; 2] {
    irises.unwrap_or_else(|| {
        [36, 42].map(|first| {
            let sum = (first..first + 6).fold(Point::ZERO, |sum, i| sum + landmarks[i]);
            Iris { centre: sum * (1.0 / 6.0), radius: 0.25 * landmarks[first].distance(landmarks[first + 3]) }
        })
    })
}

/// Depth of each landmark towards the viewer in outer-eye distances, of an average face (own estimate; the nose tip is
/// the nearest point, the ears lie farthest back).
pub const AVERAGE_DEPTH: [f64; N_LANDMARKS] = [
    -0.75, -0.72, -0.66, -0.55, -0.42, -0.25, -0.08, 0.05, 0.10, 0.05, -0.08, -0.25, -0.42, -0.55, -0.66, -0.72, -0.75,
    -0.25, -0.08, 0.00, 0.05, 0.08, 0.08, 0.05, 0.00, -0.08, -0.25, // brows
    0.12, 0.22, 0.33, 0.45, 0.20, 0.24, 0.28, 0.24, 0.20, // nose
    -0.20, -0.10, -0.07, -0.06, -0.07, -0.10, -0.06, -0.07, -0.10, -0.20, -0.10, -0.07, // eyes
    0.00, 0.10, 0.17, 0.18, 0.17, 0.10, 0.00, 0.10, 0.15, 0.17, 0.15, 0.10, // outer lips
    0.02, 0.12, 0.15, 0.12, 0.02, 0.12, 0.14, 0.12, // inner lips
];

/// Given depths shifted so that the eyes lie where the average face has them (detectors choose their own origin); the
/// average face's when none are given.
#[must_use]
pub fn aligned_depth(depth: Option<&[f64; N_LANDMARKS]>) -> [f64; N_LANDMARKS] {
    let Some(depth) = depth else {
        return AVERAGE_DEPTH;
    };
    let eyes = [36, 39, 42, 45];
    let shift = eyes.iter().map(|&i| AVERAGE_DEPTH[i] - depth[i]).sum::<f64>() / 4.0;
    depth.map(|z| z + shift)
}
