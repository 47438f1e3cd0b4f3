//! Finds the triangles and edges near a place, by a uniform grid over the moving part of the mesh.

use super::Mesh;
use crate::point::Point;

/// Cells a side; with 130 vertices a cell of the face holds three to six edges.
const CELLS: usize = 48;

/// Triangles and edges whose bounding boxes touch each cell; everything beyond the grid belongs to its border cells.
#[derive(Clone, Debug)]
pub struct Grid {
    low: Point,
    cells_per_pixel: Point,
    triangles: Vec<Vec<u32>>,
    edges: Vec<Vec<u32>>,
}

impl Grid {
    /// Grid over the box from `low` to `high`.
    #[must_use]
    pub fn new(mesh: &Mesh, low: Point, high: Point) -> Self {
        let size = high - low;
        let mut grid = Self {
            low,
            cells_per_pixel: Point::new(CELLS as f64 / size.x, CELLS as f64 / size.y),
            triangles: vec![Vec::new(); CELLS * CELLS],
            edges: vec![Vec::new(); CELLS * CELLS],
        };
        for (index, triangle) in mesh.triangles.iter().enumerate() {
            let corners = triangle.vertices.map(|vertex| mesh.rest[vertex]);
            for cell in grid.cells(&corners) {
                grid.triangles[cell].push(index as u32);
            }
        }
        for (index, edge) in mesh.edges.iter().enumerate() {
            let ends = edge.map(|vertex| mesh.rest[vertex]);
            for cell in grid.cells(&ends) {
                if grid.may_touch(cell, ends) {
                    grid.edges[cell].push(index as u32);
                }
            }
        }
        grid
    }

    /// Triangle that contains `p`; for a point outside all, the one it is least outside of.
    #[must_use]
    pub fn locate(&self, mesh: &Mesh, p: Point) -> usize {
        let inside = |triangle: usize| mesh.barycentric(triangle, p).into_iter().fold(f64::INFINITY, f64::min);
        let mut best = (0, f64::NEG_INFINITY);
        let (column, row) = self.cell(p);
        for &triangle in &self.triangles[row * CELLS + column] {
            let depth = inside(triangle as usize);
            if depth >= 0.0 {
                return triangle as usize;
            }
            if depth > best.1 {
                best = (triangle as usize, depth);
            }
        }
        if best.1 < -OUTSIDE {
            for triangle in 0..mesh.triangles.len() {
                let depth = inside(triangle);
                if depth > best.1 {
                    best = (triangle, depth);
                }
            }
        }
        best.0
    }

    /// Edges near the hull of `points`, ascending, each once; replaces the content of `found`.
    pub fn edges_near(&self, points: &[Point], found: &mut Vec<u32>) {
        found.clear();
        for cell in self.cells(points) {
            found.extend_from_slice(&self.edges[cell]);
        }
        found.sort_unstable();
        found.dedup();
    }

    fn cell(&self, p: Point) -> (usize, usize) {
        let place = |value: f64, low: f64, scale: f64| (((value - low) * scale).max(0.0) as usize).min(CELLS - 1);
        (place(p.x, self.low.x, self.cells_per_pixel.x), place(p.y, self.low.y, self.cells_per_pixel.y))
    }

    fn cells(&self, points: &[Point]) -> impl Iterator<Item = usize> + use<> {
        let (low, high) = bounds(points);
        let ((left, top), (right, bottom)) = (self.cell(low), self.cell(high));
        (top..=bottom).flat_map(move |row| (left..=right).map(move |column| row * CELLS + column))
    }

    /// Whether the line through `ends` passes the cell; border cells, which are unbounded, always count.
    fn may_touch(&self, cell: usize, ends: [Point; 2]) -> bool {
        let (column, row) = (cell % CELLS, cell / CELLS);
        if column == 0 || row == 0 || column == CELLS - 1 || row == CELLS - 1 {
            return true;
        }
        let half = Point::new(0.5 / self.cells_per_pixel.x, 0.5 / self.cells_per_pixel.y);
        let middle = self.low + Point::new((2 * column + 1) as f64 * half.x, (2 * row + 1) as f64 * half.y);
        let along = ends[1] - ends[0];
        let reach = along.x.abs() * half.y + along.y.abs() * half.x;
        along.cross(middle - ends[0]).abs() <= reach * (1.0 + 1e-9)
    }
}

/// Barycentric distance beyond which a point missed its cell's triangles altogether.
const OUTSIDE: f64 = 1e-6;

/// Smallest box around the points.
#[must_use]
pub fn bounds(points: &[Point]) -> (Point, Point) {
    let start = (Point::new(f64::INFINITY, f64::INFINITY), Point::new(f64::NEG_INFINITY, f64::NEG_INFINITY));
    points.iter().fold(start, |(low, high), p| {
        (Point::new(low.x.min(p.x), low.y.min(p.y)), Point::new(high.x.max(p.x), high.y.max(p.y)))
    })
}
