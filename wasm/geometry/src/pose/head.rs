//! Turns the head about the base of the neck: a rotation in space seen in weak perspective, as displacements from rest.

use super::channel::{Channel, Pose};
use crate::face::Face;
use crate::mesh::VertexSet;
use crate::point::Point;

/// The axis of yaw and pitch lies this far behind the eyes' corners, in outer-eye distances.
const AXIS_DEPTH: f64 = 0.5;
/// Distance of the viewer, in face widths.
const VIEWER: f64 = 4.0;

/// Positions after the head's motion; a vertex takes its `head_weight` of the displacement.
#[must_use]
pub fn turn(positions: &[Point], set: &VertexSet, face: &Face, pose: &Pose) -> Vec<Point> {
    let angles = [Channel::Yaw, Channel::Pitch, Channel::Roll].map(|channel| pose.value(channel).to_radians());
    if angles == [0.0; 3] {
        return positions.to_vec();
    }
    let viewer = VIEWER * face.width;
    let project = |p: [f64; 3]| Point::new(p[0], p[1]) * (viewer / (viewer - p[2]));
    positions
        .iter()
        .enumerate()
        .map(|(i, &position)| {
            let from_pivot = position - face.pivot;
            let z = (set.depth[i] + AXIS_DEPTH) * face.eye_distance;
            let local = [from_pivot.dot(face.right), from_pivot.dot(face.down), z];
            let shift = project(rotate(local, angles)) - project(local);
            position + face.vector(shift.x, shift.y) * set.head_weight[i]
        })
        .collect()
}

/// Yaw about the vertical, then pitch about the line through the ears, then roll in the picture plane.
/// x to the image's right, y down, z towards the viewer.
fn rotate([x, y, z]: [f64; 3], [yaw, pitch, roll]: [f64; 3]) -> [f64; 3] {
    let (x, z) = (x * yaw.cos() + z * yaw.sin(), z * yaw.cos() - x * yaw.sin());
    let (y, z) = (y * pitch.cos() + z * pitch.sin(), z * pitch.cos() - y * pitch.sin());
    let (x, y) = (x * roll.cos() - y * roll.sin(), x * roll.sin() + y * roll.cos());
    [x, y, z]
}
