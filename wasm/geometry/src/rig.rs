//! Binds a scene to a face: build once, then vertices from a pose and control points from vertices.

use crate::bound::{BoundPaths, Frame, Options};
use crate::error::RigError;
use crate::face::{Face, Iris, Landmarks, aligned_depth, irises_or_eye_centres};
use crate::mesh::vertices::{FIRST_SKIN, IRIS, TONGUE};
use crate::mesh::{Mesh, VertexSet};
use crate::opening::{N_LANDMARKS, Opening, snap_closed};
use crate::point::Point;
use crate::pose::clamp::{Limit, clamp_motion};
use crate::pose::{Channel, Pose, eyes, head, mouth};
use crate::scene::SceneGeometry;

/// A resting face; depth is in outer-eye distances, towards the viewer.
#[derive(Clone, Debug)]
pub struct RestFace {
    pub landmarks: Landmarks,
    pub irises: Option<[Iris; 2]>,
    pub depth: Option<[f64; N_LANDMARKS]>,
}

impl RestFace {
    /// # Errors
    /// `RigError::Landmarks` when an iris or a depth is not finite; `Face::measure` asks the landmarks themselves.
    fn check(&self) -> Result<(), RigError> {
        let is_finite = |iris: &Iris| iris.centre.is_finite() && iris.radius.is_finite();
        if !self.irises.iter().flatten().all(is_finite) {
            return Err(RigError::Landmarks("an iris is not a finite disc".into()));
        }
        match self.depth.iter().flatten().position(|z| !z.is_finite()) {
            Some(index) => Err(RigError::Landmarks(format!("the depth of landmark {index} is not a finite number"))),
            None => Ok(()),
        }
    }
}

/// A rigged scene. Its topology (triangles, split points, bindings) never changes.
#[derive(Clone, Debug)]
pub struct Rig {
    face: Face,
    landmarks: Landmarks,
    irises: [Iris; 2],
    set: VertexSet,
    mesh: Mesh,
    paths: BoundPaths,
}

impl Rig {
    /// # Errors
    /// `RigError::Landmarks` for a face without extent, `RigError::Scene` for arrays that do not fit together.
    pub fn build(scene: &SceneGeometry, rest: &RestFace, options: Options) -> Result<Self, RigError> {
        scene.check()?;
        rest.check()?;
        let face = Face::measure(&rest.landmarks)?;
        let landmarks = snap_closed(&rest.landmarks);
        let closed: Vec<Opening> = Opening::ALL.into_iter().filter(|opening| opening.is_closed(&landmarks)).collect();
        let depth = aligned_depth(rest.depth.as_ref());
        let irises = irises_or_eye_centres(&landmarks, rest.irises);
        let set = VertexSet::place(&face, &landmarks, &irises, &depth, &scene.extent());
        let mesh = Mesh::build(set.rest.clone(), set.triangulated(), &closed)?;
        let mouth_closed = closed.contains(&Opening::Mouth);
        let mut rig = Self { face, landmarks, irises, set, mesh, paths: BoundPaths::default() };
        rig.free_lids(&closed)?;
        let expressions: Vec<Vec<Point>> = EXTREMES.iter().map(|pose| rig.vertices(&Pose::of(pose)).0).collect();
        head::relax_depth(&mut rig.set, &rig.mesh, &rig.face, &expressions);
        rig.paths = BoundPaths::bind(scene, &rig.mesh, &rig.set, options, mouth_closed);
        Ok(rig)
    }

    /// Drops the bands of lids and brows that would keep the eyes from closing: a thicker lash line is the smaller evil.
    fn free_lids(&mut self, closed: &[Opening]) -> Result<(), RigError> {
        for _ in 0..MAX_DROPS {
            let limit = self.vertices(&Pose::of(&SHUT_EYES)).1;
            let in_way = |vertex: &usize| *vertex >= FIRST_SKIN && !self.set.follows[*vertex].is_empty();
            let limiting = limit.triangles.iter().flat_map(|&triangle| self.mesh.triangles[triangle].vertices);
            let mut dropped: Vec<usize> = limiting.filter(in_way).collect();
            if dropped.is_empty() {
                break;
            }
            dropped.sort_unstable();
            dropped.dedup();
            self.set.drop_vertices(&dropped);
            self.mesh = Mesh::build(self.set.rest.clone(), self.set.triangulated(), closed)?;
        }
        Ok(())
    }

    #[must_use]
    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    #[must_use]
    pub fn face(&self) -> &Face {
        &self.face
    }

    #[must_use]
    pub fn paths(&self) -> &BoundPaths {
        &self.paths
    }

    #[must_use]
    pub fn rest_vertices(&self) -> &[Point] {
        &self.set.rest
    }

    /// Vertex positions of a pose, and how far it had to be held back.
    ///
    /// Motion is applied in stages (mouth, eyes, offsets, head), each kept from turning a triangle over, so that a
    /// drag that goes too far holds back itself and nothing else.
    #[must_use]
    pub fn vertices(&self, pose: &Pose) -> (Vec<Point>, Limit) {
        let (face, rest) = (&self.face, &self.landmarks);
        let mut anchors = Anchors::default();
        let mut stage = Stage { points: *rest, positions: self.set.rest.clone(), limit: Limit::NONE };

        mouth::articulate(&mut stage.points, rest, face, pose);
        keep_contact(&mut stage.points, rest, face);
        anchors.tongue = mouth::tongue(face, pose);
        stage.advance(&self.mesh, self.follow(&stage.points, &anchors));

        eyes::articulate(&mut stage.points, rest, face, pose);
        anchors.irises = eyes::gaze(rest, &self.irises, face, pose);
        stage.advance(&self.mesh, self.follow(&stage.points, &anchors));

        if let Some(offsets) = &pose.offsets {
            for (point, &offset) in stage.points.iter_mut().zip(offsets.iter()) {
                *point += offset * face.eye_distance;
            }
            keep_contact(&mut stage.points, rest, face);
            stage.advance(&self.mesh, self.follow(&stage.points, &anchors));
        }

        let turned = head::turn(&stage.positions, &self.set, face, head::Angles::of(pose));
        stage.advance(&self.mesh, turned);
        (stage.positions, stage.limit)
    }

    /// All vertices for expressed landmarks: followers go with theirs, irises and tongue by their own displacement too.
    fn follow(&self, points: &Landmarks, anchors: &Anchors) -> Vec<Point> {
        let displaced = |landmark: usize| points[landmark] - self.landmarks[landmark];
        let mut positions: Vec<Point> = self
            .set
            .rest
            .iter()
            .zip(&self.set.follows)
            .map(|(&rest, follows)| follows.iter().fold(rest, |sum, &(landmark, w)| sum + displaced(landmark) * w))
            .collect();
        positions[..N_LANDMARKS].copy_from_slice(points);
        positions[IRIS] += anchors.irises[0];
        positions[IRIS + 1] += anchors.irises[1];
        positions[TONGUE] += anchors.tongue;
        positions
    }

    /// Control points of the paths whose vertices differ between `since` and `vertices`.
    ///
    /// # Errors
    /// `RigError::Pose` when a list has not one position a vertex, or a position is not finite.
    pub fn frame(&self, vertices: &[Point], since: &[Point]) -> Result<Frame, RigError> {
        let n = self.set.rest.len();
        if vertices.len() != n || since.len() != n {
            let (given, before) = (vertices.len(), since.len());
            return Err(RigError::Pose(format!("{given} and {before} vertices given, the rig has {n}")));
        }
        if let Some(vertex) = vertices.iter().position(|position| !position.is_finite()) {
            return Err(RigError::Pose(format!("vertex {vertex} is not a finite point")));
        }
        let displacements: Vec<Point> = vertices.iter().zip(&self.set.rest).map(|(&now, &rest)| now - rest).collect();
        let moved: Vec<bool> = vertices.iter().zip(since).map(|(now, before)| now != before).collect();
        Ok(self.paths.frame(&displacements, &moved))
    }

    /// Outlines of the three openings for posed vertices.
    #[must_use]
    pub fn openings(&self, vertices: &[Point]) -> [Vec<Point>; 3] {
        Opening::ALL.map(|opening| opening.outline(vertices))
    }
}

const SHUT_EYES: [(Channel, f64); 2] = [(Channel::BlinkLeft, 1.0), (Channel::BlinkRight, 1.0)];
/// Rounds of dropping vertices; portraits need none to three.
const MAX_DROPS: usize = 8;

/// Expressions that bring the most triangles near their limits: the head must be free to turn in all of them.
const EXTREMES: [&[(Channel, f64)]; 3] = [
    &[],
    &[(Channel::Jaw, 1.0), (Channel::BlinkLeft, 1.0), (Channel::BlinkRight, 1.0)],
    &[
        (Channel::Smile, 1.0),
        (Channel::BlinkLeft, 1.0),
        (Channel::BlinkRight, 1.0),
        (Channel::BrowLeft, -1.0),
        (Channel::BrowRight, -1.0),
    ],
];

/// Displacements of vertices that are not expressed by landmarks.
#[derive(Default)]
struct Anchors {
    irises: [Point; 2],
    tongue: Point,
}

/// A pose on its way from rest: what the landmarks ask for, and where the vertices may be.
struct Stage {
    points: Landmarks,
    positions: Vec<Point>,
    limit: Limit,
}

impl Stage {
    fn advance(&mut self, mesh: &Mesh, target: Vec<Point>) {
        let (positions, limit) = clamp_motion(mesh, &self.positions, &target);
        self.points.copy_from_slice(&positions[..N_LANDMARKS]);
        self.positions = positions;
        self.limit = std::mem::replace(&mut self.limit, Limit::NONE).and(limit);
    }
}

/// Lips and lids meet instead of passing through each other.
fn keep_contact(points: &mut Landmarks, rest: &Landmarks, face: &Face) {
    for opening in Opening::ALL {
        let meeting = if opening == Opening::Mouth { mouth::CONTACT } else { eyes::lid_meeting(rest, opening) };
        mouth::keep_contact(points, rest, face, opening, meeting);
    }
}
