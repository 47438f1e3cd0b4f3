//! Turns the head: yaw about the spine, nods about the joint of the skull, both seen in weak perspective and added to rest
//! as differences, so that any drawing stays itself at zero; then a tilt in the picture plane about the base of the neck.

use super::channel::{Channel, Pose};
use crate::face::Face;
use crate::mesh::{Mesh, VertexSet};
use crate::point::Point;

/// The axis of yaw and pitch lies this far behind the eyes' corners, in outer-eye distances.
const AXIS_DEPTH: f64 = 0.5;
/// Distance of the viewer, in face widths.
const VIEWER: f64 = 5.0;

/// Angles of the head, radians.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Angles {
    pub yaw: f64,
    pub pitch: f64,
    pub roll: f64,
}

impl Angles {
    #[must_use]
    pub fn of(pose: &Pose) -> Self {
        let [yaw, pitch, roll] =
            [Channel::Yaw, Channel::Pitch, Channel::Roll].map(|channel| pose.value(channel).to_radians());
        Self { yaw, pitch, roll }
    }
}

/// Positions after the head's motion; a vertex takes its `head_weight` of the displacement.
#[must_use]
pub fn turn(positions: &[Point], set: &VertexSet, face: &Face, angles: Angles) -> Vec<Point> {
    if angles == Angles::default() {
        return positions.to_vec();
    }
    // The skull nods on the topmost vertebra, at the height of the ear lobes.
    let joint = (face.skull_joint - face.pivot).dot(face.down);
    let viewer = VIEWER * face.width;
    let project = |p: [f64; 3]| Point::new(p[0], p[1]) * (viewer / (viewer - p[2]));
    let (sin, cos) = angles.roll.sin_cos();
    positions
        .iter()
        .enumerate()
        .map(|(i, &position)| {
            let from_pivot = position - face.pivot;
            let flat = Point::new(from_pivot.dot(face.right), from_pivot.dot(face.down));
            let local = [flat.x, flat.y, (set.depth[i] + AXIS_DEPTH) * face.eye_distance];
            let turned = flat + project(rotate(local, joint, angles)) - project(local);
            let shift = turned.complex_mul(Point::new(cos, sin)) - flat;
            position + face.vector(shift.x, shift.y) * set.head_weight[i]
        })
        .collect()
}

/// Yaw about the vertical, then pitch about the line through the ears at height `joint`.
/// x to the image's right, y down, z towards the viewer.
fn rotate([x, y, z]: [f64; 3], joint: f64, angles: Angles) -> [f64; 3] {
    let ((yaw_sin, yaw_cos), (pitch_sin, pitch_cos)) = (angles.yaw.sin_cos(), angles.pitch.sin_cos());
    let (x, z) = (x * yaw_cos + z * yaw_sin, z * yaw_cos - x * yaw_sin);
    let above = y - joint;
    [x, joint + above * pitch_cos + z * pitch_sin, z * pitch_cos - above * pitch_sin]
}

/// Flattens the depths of `set` where turning the head would fold the mesh: at silhouettes, where a point far back lies
/// next to one in front. Triangles that shrink too much at the extreme turns of any of `expressions` (vertices of a face
/// yet unturned) even out their depths until none does.
pub fn relax_depth(set: &mut VertexSet, mesh: &Mesh, face: &Face, expressions: &[Vec<Point>]) {
    for _ in 0..MAX_SWEEPS {
        let mut pull = vec![(0.0, 0.0); set.depth.len()];
        for (expressed, (yaw, pitch)) in expressions.iter().flat_map(|e| CORNERS.map(|corner| (e, corner))) {
            let turned = turn(expressed, set, face, Angles { yaw, pitch, roll: 0.0 });
            for (index, triangle) in mesh.triangles.iter().enumerate() {
                if mesh.double_area(index, &turned) < LEAST_SHARE * mesh.double_area(index, expressed) {
                    let mean = triangle.vertices.iter().map(|&vertex| set.depth[vertex]).sum::<f64>() / 3.0;
                    for vertex in triangle.vertices {
                        pull[vertex].0 += mean;
                        pull[vertex].1 += 1.0;
                    }
                }
            }
        }
        if pull.iter().all(|&(_, n)| n == 0.0) {
            return;
        }
        for (depth, (sum, n)) in set.depth.iter_mut().zip(pull) {
            if n > 0.0 {
                *depth = depth.midpoint(sum / n);
            }
        }
        set.settle_depth();
    }
}

/// Turns that must not fold the mesh, radians (25° and 15°).
const WIDEST_YAW: f64 = 0.436;
const WIDEST_PITCH: f64 = 0.262;
const CORNERS: [(f64, f64); 4] = [
    (WIDEST_YAW, WIDEST_PITCH),
    (WIDEST_YAW, -WIDEST_PITCH),
    (-WIDEST_YAW, WIDEST_PITCH),
    (-WIDEST_YAW, -WIDEST_PITCH),
];
/// Share of its area that a triangle keeps at those turns.
const LEAST_SHARE: f64 = 0.25;
/// Every sweep halves the differences it finds; portraits need 10 to 30.
const MAX_SWEEPS: usize = 60;
