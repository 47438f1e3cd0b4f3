//! Turns rest vertices into a triangle mesh: constrained Delaunay, with the contours of the openings as constraints and a
//! slit, not triangles, where an opening rests closed.

use std::collections::BTreeMap;

use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation as _};

use crate::error::RigError;
use crate::opening::Opening;
use crate::point::Point;
use crate::polygon::contains;

/// Vertex indices, counter-clockwise in mathematical orientation (positive cross product).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Triangle {
    pub vertices: [usize; 3],
    /// The open eye or mouth it lies in; such triangles may collapse when the opening closes.
    pub interior: Option<Opening>,
}

/// Triangles and edges over all rest vertices; vertices that take no part (anchors of local parts) are in no triangle.
#[derive(Clone, Debug)]
pub struct Mesh {
    pub rest: Vec<Point>,
    pub triangles: Vec<Triangle>,
    /// Each pair of vertices once; of the two sides of a slit only the upper one.
    pub edges: Vec<[usize; 2]>,
    /// Vertices that coincide at rest across a slit: (upper, lower).
    pub partners: Vec<(usize, usize)>,
}

type Delaunay = ConstrainedDelaunayTriangulation<Point2<f64>>;

impl Mesh {
    /// Mesh over the vertices `triangulated`; `closed` openings become slits whose contours coincide in `rest`.
    ///
    /// # Errors
    /// `RigError::Landmarks` when coordinates are beyond the triangulation's range.
    pub fn build(
        rest: Vec<Point>,
        triangulated: impl Iterator<Item = usize>,
        closed: &[Opening],
    ) -> Result<Self, RigError> {
        let mut delaunay = Delaunay::new();
        let mut handles = BTreeMap::new();
        let mut first_vertex = Vec::new();
        for vertex in triangulated {
            let handle = delaunay
                .insert(Point2::new(rest[vertex].x, rest[vertex].y))
                .map_err(|error| RigError::Landmarks(format!("vertex {vertex}: {error}")))?;
            if handle.index() == first_vertex.len() {
                first_vertex.push(vertex);
            }
            handles.insert(vertex, handle);
        }
        for opening in Opening::ALL {
            for contour in [opening.upper(), opening.lower()] {
                for ends in contour.windows(2) {
                    let (from, to) = (handles[&ends[0]], handles[&ends[1]]);
                    // Contours that cross each other (a bad detection) cannot all be constraints; the mesh is valid without.
                    if from != to && delaunay.can_add_constraint(from, to) {
                        delaunay.add_constraint(from, to);
                    }
                }
            }
        }
        let triangles = delaunay
            .inner_faces()
            .map(|face| {
                let canonical = face.vertices().map(|vertex| first_vertex[vertex.index()]);
                let centroid = canonical.iter().fold(Point::ZERO, |sum, &v| sum + rest[v]) * (1.0 / 3.0);
                Triangle {
                    vertices: canonical.map(|vertex| slit_side(vertex, centroid, closed, &rest)),
                    interior: opening_around(centroid, closed, &rest),
                }
            })
            .collect::<Vec<_>>();
        let edges = unique_edges(&triangles, &rest);
        let partners = closed.iter().flat_map(|opening| opening.pairs()).collect();
        Ok(Self { rest, triangles, edges, partners })
    }

    /// Ends of an edge as the given triangle beside it has them: their partners below, if it lies below a slit.
    #[must_use]
    pub fn side_of_edge(&self, edge: usize, triangle: usize) -> [usize; 2] {
        let vertices = self.triangles[triangle].vertices;
        let upper = self.edges[edge];
        let lower = upper.map(|vertex| {
            self.partners.iter().find(|(partner, _)| *partner == vertex).map_or(vertex, |&(_, lower)| lower)
        });
        if lower.iter().all(|vertex| vertices.contains(vertex)) { lower } else { upper }
    }

    /// Twice the signed area of a triangle with its vertices at `positions`.
    #[must_use]
    pub fn double_area(&self, triangle: usize, positions: &[Point]) -> f64 {
        let [a, b, c] = self.triangles[triangle].vertices.map(|vertex| positions[vertex]);
        (b - a).cross(c - a)
    }

    /// Barycentric weights of `p` in a resting triangle; they extrapolate outside it.
    #[must_use]
    pub fn barycentric(&self, triangle: usize, p: Point) -> [f64; 3] {
        let [a, b, c] = self.triangles[triangle].vertices.map(|vertex| self.rest[vertex]);
        let area = (b - a).cross(c - a);
        let (wa, wb) = ((b - p).cross(c - p) / area, (c - p).cross(a - p) / area);
        [wa, wb, 1.0 - wa - wb]
    }
}

/// `vertex`, or its partner below the slit when the triangle's centroid lies below it.
fn slit_side(vertex: usize, centroid: Point, closed: &[Opening], rest: &[Point]) -> usize {
    for opening in closed {
        let upper = opening.upper();
        let Some(place) = upper[1..upper.len() - 1].iter().position(|&v| v == vertex) else {
            continue;
        };
        let (previous, next) = (rest[upper[place]], rest[upper[place + 2]]);
        let turn = |to: Point| {
            let (from, to) = (next - rest[vertex], to - rest[vertex]);
            from.cross(to).atan2(from.dot(to)).rem_euclid(std::f64::consts::TAU)
        };
        if turn(centroid) < turn(previous) {
            return opening.lower()[place + 1];
        }
    }
    vertex
}

/// The open opening whose landmark polygon contains `p` (even-odd rule).
fn opening_around(p: Point, closed: &[Opening], rest: &[Point]) -> Option<Opening> {
    let polygon = |opening: &Opening| opening.ring().into_iter().map(|vertex| rest[vertex]).collect::<Vec<_>>();
    Opening::ALL.into_iter().filter(|opening| !closed.contains(opening)).find(|opening| contains(&polygon(opening), p))
}

/// Edges of all triangles; two edges that coincide at rest (the sides of a slit) count once, as the one of lower indices.
fn unique_edges(triangles: &[Triangle], rest: &[Point]) -> Vec<[usize; 2]> {
    let key = |vertex: usize| (rest[vertex].x.to_bits(), rest[vertex].y.to_bits());
    let mut edges = BTreeMap::new();
    for triangle in triangles {
        let [a, b, c] = triangle.vertices;
        for (from, to) in [(a, b), (b, c), (c, a)] {
            let ends = [from.min(to), from.max(to)];
            let place =
                if key(ends[0]) < key(ends[1]) { (key(ends[0]), key(ends[1])) } else { (key(ends[1]), key(ends[0])) };
            edges.entry(place).and_modify(|known: &mut [usize; 2]| *known = ends.min(*known)).or_insert(ends);
        }
    }
    let mut edges: Vec<[usize; 2]> = edges.into_values().collect();
    edges.sort_unstable();
    edges
}
