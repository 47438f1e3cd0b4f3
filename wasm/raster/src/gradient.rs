//! Carries the gradients of a path's chords to its control points.

use crate::cover::{Cover, Tile};
use crate::flatten::Chords;

/// Adds the gradients of one tile's pieces to its path's control points, `grad_points [S, 3, 2]`.
///
/// Reynolds' transport theorem: for a chord `P(t) = (1 − t)·P0 + t·P1`, `Δ = P1 − P0` and `G = ∂loss/∂winding`,
/// `∂loss/∂P1 = (−Δy, Δx)·∫G·t dt`, likewise `P0` with `1 − t`; downward edges wind positively to their right.
pub fn add_tile<const S: usize>(chords: &Chords, cover: &Cover<S>, tile: &Tile, grad_points: &mut [f32]) {
    let mut moments = [[0.0_f32; 4]; 2];
    let mut current = None;
    cover.integrate(tile, |piece, [whole, end]| {
        let v = piece.vertex as usize;
        let segment = chords.segment[v];
        if current != Some(segment) {
            spread(chords, current.replace(segment), std::mem::take(&mut moments), grad_points);
        }
        let segment = segment as usize;
        let (k, n) = (piece.vertex - chords.start[segment], chords.count[segment]);
        let (at_start, at_end) = (weights(k, n), weights(k + 1, n));
        let normal = [chords.y[v] - chords.y[v + 1], chords.x[v + 1] - chords.x[v]];
        for power in 0..4 {
            let share = at_start[power] * (whole - end) + at_end[power] * end;
            moments[0][power] += share * normal[0];
            moments[1][power] += share * normal[1];
        }
    });
    spread(chords, current, moments, grad_points);
}

/// Adds sums over weights of one segment's vertices to its four control points.
fn spread(chords: &Chords, segment: Option<u32>, moments: [[f32; 4]; 2], grad_points: &mut [f32]) {
    let Some(segment) = segment.map(|segment| segment as usize) else { return };
    let first = segment % chords.segments * 6;
    let step = 1.0 / chords.count[segment] as f32;
    for (axis, [m0, m1, m2, m3]) in moments.into_iter().enumerate() {
        let by_powers = [m0, m1 * step, m2 * step * step, m3 * step * step * step];
        for (j, g) in bernstein(by_powers).into_iter().enumerate() {
            let at = first + 2 * j + axis;
            grad_points[if at < grad_points.len() { at } else { at - grad_points.len() }] += g;
        }
    }
}

/// How vertex `k` of `n` depends on its cubic's coefficients, in powers of `n`: powers of `k`, less `n²` times those of
/// `P''/12n²` between the ends.
#[inline(always)]
fn weights(k: u32, n: u32) -> [f32; 4] {
    let moved = if k == 0 || k == n { 0.0 } else { 1.0 / 6.0 };
    let k = k as i32 as f32;
    [1.0, k, k * k - moved, k * (k * k - 3.0 * moved)]
}

/// Sums over powers of `t` turned into sums over the Bernstein weights of the four control points.
fn bernstein([m0, m1, m2, m3]: [f32; 4]) -> [f32; 4] {
    [m0 - 3.0 * (m1 - m2) - m3, 3.0 * (m1 - 2.0 * m2 + m3), 3.0 * (m2 - m3), m3]
}
