//! Places the vertices of a rig: landmarks, irises, anchors of the local parts, and the rings that carry motion softly
//! from the face to hair, neck, shoulders and the still frame.

use crate::face::{Face, Iris, Landmarks};
use crate::opening::{N_LANDMARKS, Opening};
use crate::point::Point;

/// Image-left iris; the image-right one follows.
pub const IRIS: usize = N_LANDMARKS;
/// Image-left and image-right anchor of parts that move with the skull (at the mouth corners' depth).
pub const SKULL: usize = IRIS + 2;
/// The same two places, moving with the lower jaw.
pub const JAW: usize = SKULL + 2;
/// Tip of the tongue.
pub const TONGUE: usize = JAW + 2;
/// First vertex that is only there to shape the mesh.
pub const FIRST_SKIN: usize = TONGUE + 1;

/// Vertices at rest and how each takes part in the two kinds of motion; all arrays have one entry a vertex.
#[derive(Clone, Debug)]
pub struct VertexSet {
    pub rest: Vec<Point>,
    /// Share of the head's rigid motion: 1 on the skull, 0 on shoulders and frame.
    pub head_weight: Vec<f64>,
    /// Towards the viewer, in outer-eye distances.
    pub depth: Vec<f64>,
    /// (landmark, weight): the vertex moves by the weighted sum of these landmarks' expressions.
    pub follows: Vec<Vec<(usize, f64)>>,
}

/// Frame of the picture and what else the mesh must cover.
#[derive(Clone, Copy, Debug)]
pub struct Extent {
    pub width: f64,
    pub height: f64,
    /// Smallest and largest coordinates of the warped paths.
    pub lowest: Point,
    pub highest: Point,
}

impl VertexSet {
    /// Vertices for a face; `depth` as `face::aligned_depth` gives it.
    #[must_use]
    pub fn place(
        face: &Face,
        landmarks: &Landmarks,
        irises: &[Iris; 2],
        depth: &[f64; N_LANDMARKS],
        extent: &Extent,
    ) -> Self {
        let mut set = Self {
            rest: landmarks.to_vec(),
            head_weight: vec![1.0; N_LANDMARKS],
            depth: depth.to_vec(),
            follows: vec![Vec::new(); N_LANDMARKS],
        };
        set.add_part_anchors(face, landmarks, irises);
        set.add_lid_bands(face, landmarks, depth);
        set.add_cheeks(face, landmarks, depth);
        set.add_head_rings(face, landmarks);
        set.add_neck(face, landmarks);
        set.add_still_anchors(face, extent);
        set
    }

    /// Vertices of the triangulation: landmarks and skin, not the anchors of local parts.
    pub fn triangulated(&self) -> impl Iterator<Item = usize> {
        (0..N_LANDMARKS).chain(FIRST_SKIN..self.rest.len())
    }

    /// Rest positions of the vertices that can ever move.
    #[must_use]
    pub fn moving(&self) -> Vec<Point> {
        self.rest.iter().zip(&self.head_weight).filter(|(_, weight)| **weight > 0.0).map(|(&rest, _)| rest).collect()
    }

    /// Landmarks between an eye's corners, and the vertices that go with them.
    #[must_use]
    pub fn lids(&self, eye: Opening) -> Vec<usize> {
        let lids: Vec<usize> = eye.pairs().flat_map(|(upper, lower)| [upper, lower]).collect();
        let follows = |vertex: &usize| self.follows[*vertex].iter().any(|(landmark, _)| lids.contains(landmark));
        let bands: Vec<usize> = (0..self.rest.len()).filter(follows).collect();
        [lids, bands].concat()
    }

    /// Leaves out vertices that only shape the mesh; `dropped` ascending, from `FIRST_SKIN` on.
    pub fn drop_vertices(&mut self, dropped: &[usize]) {
        for &vertex in dropped.iter().rev() {
            self.rest.remove(vertex);
            self.head_weight.remove(vertex);
            self.depth.remove(vertex);
            self.follows.remove(vertex);
        }
    }

    fn add(&mut self, rest: Point, head_weight: f64, depth: f64, follows: &[(usize, f64)]) {
        self.rest.push(rest);
        self.head_weight.push(head_weight);
        self.depth.push(depth);
        self.follows.push(follows.to_vec());
    }

    fn add_part_anchors(&mut self, face: &Face, landmarks: &Landmarks, irises: &[Iris; 2]) {
        for iris in irises {
            self.add(iris.centre, 1.0, 0.0, &[]);
        }
        let corners = [landmarks[48], landmarks[54]];
        for corner in corners {
            self.add(corner, 1.0, 0.0, &[]);
        }
        // The lower teeth sit in the jaw bone, which the chin shows best.
        for corner in corners {
            self.add(corner, 1.0, 0.0, &CHIN);
        }
        let tongue = landmarks[62].lerp(landmarks[66], 0.5) + face.down * (0.1 * face.mouth_width);
        self.add(tongue, 1.0, 0.0, &CHIN);
        self.settle_depth();
    }

    /// Gives the anchors of local parts the depth of the openings they show through, and one depth to the two points of a
    /// contour that meet, so that what is closed stays closed when the head turns.
    pub fn settle_depth(&mut self) {
        for opening in Opening::ALL {
            for (upper, lower) in opening.pairs() {
                let middle = self.depth[upper].midpoint(self.depth[lower]);
                (self.depth[upper], self.depth[lower]) = (middle, middle);
            }
            let ring = opening.ring();
            let mean = ring.iter().map(|&landmark| self.depth[landmark]).sum::<f64>() / ring.len() as f64;
            match opening {
                Opening::LeftEye => self.depth[IRIS] = mean,
                Opening::RightEye => self.depth[IRIS + 1] = mean,
                Opening::Mouth => self.depth[SKULL..FIRST_SKIN].fill(mean),
            }
        }
    }

    /// Bands that go rigidly with lids and brows, so that lash lines and brows keep their thickness and only the plain
    /// skin between them stretches; and a still point above each corner, past which a closing lid may sink.
    fn add_lid_bands(&mut self, face: &Face, landmarks: &Landmarks, depth: &[f64]) {
        let least = MIN_BAND * face.eye_distance;
        let sides =
            [([36, 39], [(37, 41, 19), (38, 40, 20)], 18..22), ([42, 45], [(43, 47, 23), (44, 46, 24)], 22..26)];
        for (corners, lids, brow) in sides {
            let mut room = f64::INFINITY;
            for (upper, lower, above) in lids {
                let space = (landmarks[upper] - landmarks[above]).dot(face.down);
                // Along the lid's own way of closing: the band then keeps clear of the corners.
                let open = landmarks[lower] - landmarks[upper];
                let way = if open.norm() > least { open * (1.0 / open.norm()) } else { face.down };
                let lash = LASH_BAND * open.norm().max(least);
                if space > least {
                    self.add(landmarks[upper] - way * lash.min(0.25 * space), 1.0, depth[upper], &[(upper, 1.0)]);
                }
                self.add(landmarks[lower] + way * lash, 1.0, depth[lower], &[(lower, 1.0)]);
                room = room.min(space);
            }
            if room > least {
                let shift = face.down * (BROW_BAND * face.eye_distance).min(0.35 * room);
                for point in brow {
                    self.add(landmarks[point] + shift, 1.0, depth[point], &[(point, 1.0)]);
                }
                for (corner, outwards) in corners.into_iter().zip([-1.0, 1.0]) {
                    let above = face.vector(0.015 * outwards * face.eye_distance, -0.35 * room);
                    self.add(landmarks[corner] + above, 1.0, depth[corner], &[(corner, 1.0)]);
                }
            }
        }
    }

    /// Cheeks that keep a moving jaw or mouth corner from pulling at the eyes. Large eyes reach down to where the upper ones
    /// would be: a vertex beside a resting lid, moved by the mouth, would soon turn the triangle between them over.
    fn add_cheeks(&mut self, face: &Face, landmarks: &Landmarks, depth: &[f64]) {
        let least = LEAST_SPACING * face.eye_distance;
        for (jaw_high, jaw_low, nostril, corner) in [(2, 4, 31, 48), (14, 12, 35, 54)] {
            for (jaw, inner, share) in [(jaw_high, nostril, 0.2), (jaw_low, corner, 0.5)] {
                let cheek = landmarks[jaw].lerp(landmarks[inner], 0.5);
                if self.rest.iter().all(|vertex| vertex.distance(cheek) > least) {
                    let z = depth[jaw].midpoint(depth[inner]) + 0.1;
                    self.add(cheek, 1.0, z, &[(corner, share), (jaw, share)]);
                }
            }
        }
    }

    /// Forehead and two rings of hair around the head; all turn with it, the outer ring a little less.
    fn add_head_rings(&mut self, face: &Face, landmarks: &Landmarks) {
        let brow = landmarks[19].lerp(landmarks[24], 0.5);
        let ears = landmarks[0].lerp(landmarks[16], 0.5);
        let centre =
            face.origin + face.vector((ears - face.origin).dot(face.right), (brow - face.origin).dot(face.down));
        let mut arc = |radius_x: f64, radius_y: f64, weight: f64, depth: f64, degrees: &[f64]| {
            for angle in degrees {
                let (sin, cos) = angle.to_radians().sin_cos();
                let offset = face.vector(radius_x * face.width * cos, -radius_y * face.height * sin);
                self.add(centre + offset, weight, depth, &[]);
            }
        };
        arc(0.44, 0.5, 1.0, -0.2, &[150.0, 120.0, 90.0, 60.0, 30.0]);
        arc(0.66, 0.95, 1.0, -0.6, &[205.0, 180.0, 155.0, 130.0, 110.0, 90.0, 70.0, 50.0, 25.0, 0.0, -25.0]);
        arc(0.95, 1.45, 0.85, -0.7, &[195.0, 165.0, 135.0, 110.0, 90.0, 70.0, 45.0, 15.0, -15.0]);
    }

    /// Hair beside the neck, throat, base of the neck, shoulders: motion fades from the head to nothing.
    fn add_neck(&mut self, face: &Face, landmarks: &Landmarks) {
        let chin = landmarks[8];
        let at = |x: f64, y: f64| chin + face.vector(x * face.width, y * face.height);
        for side in [-1.0, 1.0] {
            self.add(at(side * 0.72, 0.0), 0.8, -0.5, &[]);
            self.add(at(side * 0.85, 0.45), 0.35, -0.5, &[]);
            self.add(at(side * 0.32, 0.22), 0.65, -0.4, &[(8, 0.3)]);
            self.add(at(side * 0.42, 0.55), 0.25, -0.4, &[]);
            self.add(at(side * 0.6, 0.9), 0.0, -0.4, &[]);
            self.add(at(side * 1.3, 0.95), 0.0, -0.4, &[]);
        }
        self.add(at(0.0, 0.28), 0.6, -0.3, &[(8, 0.4)]);
        self.add(at(0.0, 0.6), 0.2, -0.3, &[(8, 0.1)]);
        self.add(at(0.0, 0.95), 0.0, -0.3, &[]);
    }

    /// Frame anchors beyond the head's reach, and outer anchors so far away that every path lies inside the mesh.
    fn add_still_anchors(&mut self, face: &Face, extent: &Extent) {
        let reach = self.rest.iter().map(|p| p.distance(face.pivot)).fold(0.0, f64::max);
        let shoulder = 1.1 * face.height;
        for anchor in border(Point::ZERO, Point::new(extent.width, extent.height)) {
            let from_pivot = anchor - face.pivot;
            if from_pivot.norm() > 1.3 * reach || from_pivot.dot(face.down) > shoulder {
                self.add(anchor, 0.0, 0.0, &[]);
            }
        }
        let frame = Point::new(extent.width, extent.height);
        let (mut low, mut high) = (frame * -0.25, frame * 1.25);
        let round = Point::new(1.7 * reach, 1.7 * reach);
        for corner in [face.pivot - round, face.pivot + round, extent.lowest, extent.highest] {
            low = Point::new(low.x.min(corner.x), low.y.min(corner.y));
            high = Point::new(high.x.max(corner.x), high.y.max(corner.y));
        }
        let margin = (high - low) * 0.05;
        for anchor in border(low - margin, high + margin) {
            self.add(anchor, 0.0, 0.0, &[]);
        }
    }
}

/// Bones of the chin, in equal parts.
const CHIN: [(usize, f64); 3] = [(7, 1.0 / 3.0), (8, 1.0 / 3.0), (9, 1.0 / 3.0)];

/// Lash band, in eye heights; covers the lash line of photos and cartoons alike.
const LASH_BAND: f64 = 0.3;
/// Thickness of a brow below its landmarks, which lie on its upper edge, in outer-eye distances.
const BROW_BAND: f64 = 0.1;
/// Bands thinner than this (outer-eye distances) are left out.
const MIN_BAND: f64 = 0.05;

/// Distance that cheeks keep from other vertices, in outer-eye distances.
const LEAST_SPACING: f64 = 0.05;

/// Corners and edge midpoints of a rectangle.
fn border(low: Point, high: Point) -> [Point; 8] {
    let mid = low.lerp(high, 0.5);
    [
        low,
        Point::new(mid.x, low.y),
        Point::new(high.x, low.y),
        Point::new(high.x, mid.y),
        high,
        Point::new(mid.x, high.y),
        Point::new(low.x, high.y),
        Point::new(low.x, mid.y),
    ]
}
