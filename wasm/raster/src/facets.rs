//! Turns cubic segments into the chords that tiny-skia and Skia walk, on their grid of a sixty-fourth of a sub-row.
//!
//! They cut a cubic where it turns in y, and take 2, 4, 8, … chords by how far its handles lie from thirds of its base.

use crate::flatten::{Chords, cubic};
use crate::scene::Paths;

/// Steps of the grid in a pixel: 4 sub-rows of 64.
const GRID: f32 = 256.0;
/// A cubic has at most this power of two of chords.
const MOST_HALVINGS: u32 = 6;

type Cubic = [[f32; 2]; 4];

/// Flattens every segment as tiny-skia's edges do; nothing but the picture can be made of these chords.
pub fn facets(paths: &Paths<'_>) -> Chords {
    let mut chords = Chords { segments: paths.segments, ..Chords::default() };
    for ring in paths.points.chunks_exact(paths.segments * 6) {
        let first = chords.x.len();
        chords.rings.push(first as u32);
        for segment in 0..paths.segments {
            let whole = cubic(ring, segment);
            let mut rest = whole;
            let mut from = 0.0;
            for t in turns(whole.map(|p| p[1])) {
                let (head, tail) = halves(rest, (t - from) / (1.0 - from));
                push(&mut chords, head);
                (rest, from) = (tail, t);
            }
            push(&mut chords, rest);
        }
        chords.x.push(chords.x[first]);
        chords.y.push(chords.y[first]);
    }
    chords.rings.push(chords.x.len() as u32);
    chords
}

/// Parameters in (0, 1) where a coordinate's derivative vanishes, ascending.
fn turns([a, b, c, d]: [f32; 4]) -> impl Iterator<Item = f32> {
    let (square, linear, constant) = (d - a + 3.0 * (b - c), 2.0 * (a - b - b + c), b - a);
    let root = (linear * linear - 4.0 * square * constant).sqrt();
    let q = -0.5 * (linear + root.copysign(linear));
    let (s, t) = (q / square, constant / q);
    let inside = |t: &f32| *t > 0.0 && *t < 1.0;
    [s.min(t), s.max(t)].into_iter().filter(inside)
}

/// Both parts of a cubic cut at `t`.
fn halves(p: Cubic, t: f32) -> (Cubic, Cubic) {
    let between = |a: [f32; 2], b: [f32; 2]| [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])];
    let [ab, bc, cd] = [between(p[0], p[1]), between(p[1], p[2]), between(p[2], p[3])];
    let (abc, bcd) = (between(ab, bc), between(bc, cd));
    let middle = between(abc, bcd);
    ([p[0], ab, abc, middle], [middle, bcd, cd, p[3]])
}

/// Appends the vertices of a cubic but for its last.
fn push(chords: &mut Chords, p: Cubic) {
    let p = p.map(|q| q.map(|v| (v * GRID).trunc()));
    let n = 1 << halvings(p);
    for k in 0..n {
        let t = k as f32 / n as f32;
        let [x, y] = [0, 1].map(|axis| {
            let [a, b, c, d] = p.map(|q| q[axis]);
            let (linear, square) = (3.0 * (b - a), 3.0 * (c - b - b + a));
            (((d - a - linear - square) * t + square) * t + linear) * t + a
        });
        chords.x.push(x / GRID);
        chords.y.push(y / GRID);
    }
}

/// How often tiny-skia halves a cubic of the grid: by the distance of its handles from where a straight line has them.
fn halvings(p: Cubic) -> u32 {
    let [dx, dy] = [0, 1].map(|axis| {
        let [a, b, c, d] = p.map(|q| q[axis]);
        let third = (8.0 * a - 15.0 * b + 6.0 * c + d) * (19.0 / 512.0);
        let two_thirds = (a + 6.0 * b - 15.0 * c + 8.0 * d) * (19.0 / 512.0);
        third.abs().max(two_thirds.abs())
    });
    let distance = dx.max(dy) + 0.5 * dx.min(dy);
    let steps = (distance as u32 + 16) >> 5;
    ((u32::BITS - steps.leading_zeros()) / 2 + 1).min(MOST_HALVINGS)
}
