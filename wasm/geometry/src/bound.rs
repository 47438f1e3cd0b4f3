//! Paths bound to a mesh: their control points at rest, and where those go when vertices move.

use crate::binding::{Bindings, Influence};
use crate::joints::{Joint, Strains, repair, smooth_joints};
use crate::local::{Part, influences, socket};
use crate::mesh::grid::{Grid, bounds};
use crate::mesh::{Mesh, VertexSet};
use crate::point::Point;
use crate::scene::{Layer, SceneGeometry};
use crate::sockets::{Cover, Sockets};
use crate::split::{Anchor, SplitPath, keep_path, split_path};

#[derive(Clone, Copy, Debug)]
pub struct Options {
    /// Split curves at triangle edges; without it each control point follows its own triangle (the paper's ablation).
    pub split: bool,
    /// Repair kinks where smooth curves pass from triangle to triangle.
    pub smooth: bool,
}

impl Default for Options {
    fn default() -> Self {
        Self { split: true, smooth: true }
    }
}

/// All paths of a scene, bound once; only coordinates change afterwards.
#[derive(Clone, Debug, Default)]
pub struct BoundPaths {
    paths: Vec<BoundPath>,
    /// Control points of all paths at rest, one path after another.
    points: Vec<Point>,
    bindings: Bindings,
    strains: Strains,
    /// Vertices of lids that have covers of their own, each with its place in the socket.
    stilled: Vec<(usize, Vec<Influence>)>,
}

#[derive(Clone, Debug)]
struct BoundPath {
    start: usize,
    end: usize,
    /// Vertices that move it, ascending.
    vertices: Vec<usize>,
    /// Whether it goes with the mesh and rests where lids are stilled.
    skin: bool,
    /// Joints whose kinks are repaired.
    smooth: Vec<Joint>,
}

/// Control points of the paths that moved.
#[derive(Clone, Debug, Default)]
pub struct Frame {
    /// Path indices, ascending.
    pub changed: Vec<usize>,
    /// `starts[k]..starts[k + 1]` are the points of path `changed[k]`.
    pub starts: Vec<usize>,
    pub points: Vec<Point>,
}

impl BoundPaths {
    /// Binds the fore to the mesh of `set`, local paths and covers of the eyes to their bones.
    #[must_use]
    pub fn bind(scene: &SceneGeometry, mesh: &Mesh, set: &VertexSet, options: Options, mouth_closed: bool) -> Self {
        let (low, high) = bounds(&set.moving());
        let grid = Grid::new(mesh, low, high);
        let sockets = Sockets::of(&mesh.rest);
        let sources: Vec<(Layer, &[Point])> = scene.paths().collect();
        let covers: Vec<Option<Cover>> = sources
            .iter()
            .map(|&(layer, source)| if layer == Layer::Fore { sockets.cover(source) } else { None })
            .collect();
        let stilled = stilled_lids(&sockets, &sources, &covers, set);
        let mut bound = Self { strains: Strains::of(mesh), stilled, ..Self::default() };
        for (&(layer, source), cover) in sources.iter().zip(covers) {
            match (layer, cover) {
                (Layer::Back, _) => bound.push(source, Vec::new(), false, |_| Vec::new()),
                (Layer::Local(part), _) => {
                    bound.push(source, Vec::new(), false, |i| influences(part, source[i], &mesh.rest, mouth_closed));
                }
                (Layer::Fore, Some(cover)) => {
                    bound.push(source, Vec::new(), false, |i| cover.influences(source[i], &mesh.rest));
                }
                (Layer::Fore, None) if options.split => {
                    let path = split_path(source, mesh, &grid);
                    let smooth = if options.smooth { smooth_joints(&path, mesh) } else { Vec::new() };
                    bound.push(&path.points, smooth, true, |i| piece_influences(mesh, &path, i));
                }
                (Layer::Fore, None) => {
                    let path = keep_path(source, mesh, &grid);
                    bound.push(&path.points, Vec::new(), true, |i| {
                        triangle_influences(mesh, grid.locate(mesh, source[i]), source[i])
                    });
                }
            }
        }
        bound
    }

    fn push(&mut self, points: &[Point], smooth: Vec<Joint>, skin: bool, influences: impl Fn(usize) -> Vec<Influence>) {
        let start = self.points.len();
        let mut vertices = Vec::new();
        for i in 0..points.len() {
            self.bindings.push(&influences(i));
            for influence in self.bindings.of(start + i) {
                match self.stilled.iter().find(|(vertex, _)| skin && *vertex == influence.vertex) {
                    Some((_, socket)) => vertices.extend(socket.iter().map(|corner| corner.vertex)),
                    None => vertices.push(influence.vertex),
                }
            }
        }
        vertices.sort_unstable();
        vertices.dedup();
        self.points.extend_from_slice(points);
        self.paths.push(BoundPath { start, end: self.points.len(), vertices, skin, smooth });
    }

    /// Displacements of the vertices as skin takes them: covered lids move over it and leave it where it is.
    fn skin_displacements(&self, displacements: &[Point]) -> Vec<Point> {
        let mut skin = displacements.to_vec();
        for (vertex, socket) in &self.stilled {
            let shares = socket.iter().map(|i| displacements[i.vertex].complex_mul(i.weight));
            skin[*vertex] = shares.fold(Point::ZERO, |sum, share| sum + share);
        }
        skin
    }

    #[must_use]
    pub fn n_paths(&self) -> usize {
        self.paths.len()
    }

    /// Control points of one path at rest, split as all its frames are; empty when there is no such path.
    #[must_use]
    pub fn rest_path(&self, path: usize) -> &[Point] {
        self.paths.get(path).map_or(&[], |path| &self.points[path.start..path.end])
    }

    /// Vertices that move a path, ascending.
    #[must_use]
    pub fn vertices_of(&self, path: usize) -> &[usize] {
        self.paths.get(path).map_or(&[], |path| &path.vertices)
    }

    /// Control points of the paths with a vertex that `moved`, for vertices displaced from rest by `displacements`.
    #[must_use]
    pub fn frame(&self, displacements: &[Point], moved: &[bool]) -> Frame {
        let skin = self.skin_displacements(displacements);
        let mut frame = Frame { starts: vec![0], ..Frame::default() };
        for (index, path) in self.paths.iter().enumerate() {
            if !path.vertices.iter().any(|&vertex| moved[vertex]) {
                continue;
            }
            frame.points.extend(self.warp(path, if path.skin { &skin } else { displacements }));
            frame.changed.push(index);
            frame.starts.push(frame.points.len());
        }
        frame
    }

    /// Control points of one path for vertices displaced from rest by `displacements`; empty when there is no such path.
    #[must_use]
    pub fn warped_path(&self, path: usize, displacements: &[Point]) -> Vec<Point> {
        match self.paths.get(path) {
            Some(path) if path.skin => self.warp(path, &self.skin_displacements(displacements)),
            Some(path) => self.warp(path, displacements),
            None => Vec::new(),
        }
    }

    fn warp(&self, path: &BoundPath, displacements: &[Point]) -> Vec<Point> {
        let warped = (path.start..path.end).map(|i| self.points[i] + self.bindings.displacement(i, displacements));
        let mut points: Vec<Point> = warped.collect();
        repair(&mut points, &path.smooth, &self.strains, displacements);
        points
    }
}

/// Vertices of the lids of eyes that a cover fills, with the influences by which they would go with their sockets.
fn stilled_lids(
    sockets: &Sockets,
    sources: &[(Layer, &[Point])],
    covers: &[Option<Cover>],
    set: &VertexSet,
) -> Vec<(usize, Vec<Influence>)> {
    let is_lidded = |eye: Part| {
        let mut covered = sources.iter().zip(covers).filter(|(_, cover)| **cover == Some(Cover::Lid(eye)));
        covered.any(|((_, source), _)| sockets.is_filled(eye, source))
    };
    let eyes = Part::EYES.into_iter().filter(|&eye| is_lidded(eye)).map(Part::opening);
    eyes.flat_map(|eye| set.lids(eye).into_iter().map(move |vertex| (eye, vertex)))
        .map(|(eye, vertex)| (vertex, socket(eye, set.rest[vertex], &set.rest)))
        .collect()
}

/// Influences on control point `i` of a split path: crossings by their edge, everything else by its piece's triangle.
fn piece_influences(mesh: &Mesh, path: &SplitPath, i: usize) -> Vec<Influence> {
    let (piece, place) = (i / 3, i % 3);
    let triangle = path.triangles[piece];
    let end_of_bridge = triangle.is_none() && place == 2;
    let anchor = if end_of_bridge { (piece + 1) % path.anchors.len() } else { piece };
    match path.anchors[anchor] {
        Anchor::Edge { ends: [a, b], s } if triangle.is_none() || place == 0 => {
            vec![Influence::real(a, 1.0 - s), Influence::real(b, s)]
        }
        _ => triangle.map_or_else(Vec::new, |triangle| triangle_influences(mesh, triangle, path.points[i])),
    }
}

fn triangle_influences(mesh: &Mesh, triangle: usize, p: Point) -> Vec<Influence> {
    let weights = mesh.barycentric(triangle, p);
    mesh.triangles[triangle].vertices.into_iter().zip(weights).map(|(vertex, w)| Influence::real(vertex, w)).collect()
}
