//! Turns cubic segments into chords, densely enough that no pixel can tell the difference.

use crate::scene::Paths;

/// Fewer chords would starve the handles of gradient: with 4 the trapezoid rule over their weights is 6 % short.
const LEAST_CHORDS: f32 = 4.0;
/// More chords are not needed below a curvature that only off-canvas or wildly folded segments have.
const MOST_CHORDS: f32 = 64.0;

/// Vertices of all paths in one list; each path's ring is closed by a copy of its first vertex.
#[derive(Debug, Default)]
pub struct Chords {
    /// Cubic segments of every path.
    pub segments: usize,
    pub x: Vec<f32>,
    pub y: Vec<f32>,
    /// Global index of the segment of the chord that starts at a vertex.
    pub segment: Vec<u32>,
    /// First vertex of each path, and the end of the last one's, `[n + 1]`; the last vertex of a ring starts no chord.
    pub rings: Vec<u32>,
    /// Vertex index where each segment starts, `[n·S]`.
    pub start: Vec<u32>,
    /// Number of chords of each segment, `[n·S]`.
    pub count: Vec<u32>,
}

/// Flattens every segment at `t = k/n`, `n` by how far the chords may stray from the cubic.
///
/// Chords between points of a curve lie on one side of it. Vertices between a segment's ends are therefore moved outward by
/// `P''/12n²`, the mean distance of a parabola from its chord, so that no area is lost.
pub fn flatten(paths: &Paths<'_>, flatness: f32) -> Chords {
    let stride = paths.segments * 6;
    let mut chords = Chords { segments: paths.segments, ..Chords::default() };
    for ring in paths.points.chunks_exact(stride) {
        let first = chords.x.len();
        for j in 0..paths.segments {
            push_segment(&mut chords, cubic(ring, j), flatness);
        }
        chords.x.push(chords.x[first]);
        chords.y.push(chords.y[first]);
        chords.segment.push(chords.start.len() as u32 - 1);
        chords.rings.push(first as u32);
    }
    chords.rings.push(chords.x.len() as u32);
    chords
}

/// Control points of segment `j` of a ring: `3j, 3j+1, 3j+2, (3j+3) mod 3S`.
pub fn cubic(ring: &[f32], j: usize) -> [[f32; 2]; 4] {
    std::array::from_fn(|k| {
        let i = (6 * j + 2 * k) % ring.len();
        [ring[i], ring[i + 1]]
    })
}

fn push_segment(chords: &mut Chords, p: [[f32; 2]; 4], flatness: f32) {
    let [x, y] = [0, 1].map(|axis| power_basis(p.map(|q| q[axis])));
    let n = n_chords(x, y, flatness);
    let step = 1.0 / n as f32;
    let segment = chords.start.len() as u32;
    chords.start.push(chords.x.len() as u32);
    chords.count.push(n);
    for (vertices, c) in [(&mut chords.x, x), (&mut chords.y, y)] {
        let moved = outward(c, step);
        vertices.push(c[0]);
        vertices.extend((1..n).map(|k| horner(moved, k as f32 * step)));
    }
    chords.segment.resize(chords.x.len(), segment);
}

/// A chord over `1/n` of a curve strays by `|P''⊥| / 8n²`; the normal part of `P''` is taken at five parameters.
fn n_chords(x: [f32; 4], y: [f32; 4], flatness: f32) -> u32 {
    let mut most = 0.0_f32;
    for t in [0.0, 0.25, 0.5, 0.75, 1.0] {
        let velocity = [x, y].map(|c| (3.0 * c[3] * t + 2.0 * c[2]) * t + c[1]);
        let acceleration = [x, y].map(|c| 6.0 * c[3] * t + 2.0 * c[2]);
        let cross = velocity[0] * acceleration[1] - velocity[1] * acceleration[0];
        let speed = velocity[0] * velocity[0] + velocity[1] * velocity[1];
        most = most.max(cross * cross / speed.max(STANDSTILL));
    }
    (most.sqrt() / (8.0 * flatness)).sqrt().ceil().clamp(LEAST_CHORDS, MOST_CHORDS) as u32
}

/// Squared speed below which a curve has no direction.
const STANDSTILL: f32 = 1e-6;

fn power_basis(p: [f32; 4]) -> [f32; 4] {
    let c1 = 3.0 * (p[1] - p[0]);
    let c2 = 3.0 * (p[2] - p[1]) - c1;
    [p[0], c1, c2, p[3] - p[0] - c1 - c2]
}

/// Power basis of `P − P''/12n²`, `step = 1/n`.
fn outward(c: [f32; 4], step: f32) -> [f32; 4] {
    let share = step * step / 6.0;
    [c[0] - share * c[2], c[1] - 3.0 * share * c[3], c[2], c[3]]
}

fn horner(c: [f32; 4], t: f32) -> f32 {
    ((c[3] * t + c[2]) * t + c[1]) * t + c[0]
}
