//! Solid and two-stop linear fills, as SVG paints them: padded, unpremultiplied, interpolated in sRGB.

use crate::walk::{Lane, ROWS};

/// Gradient of the loss by one path's fill.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct FillGradient {
    pub stops: [[f32; 4]; 2],
    pub axis: [f32; 4],
    /// Loss increase if the path were removed.
    pub importance: f64,
}

/// Colour and opacity along an axis: `first + position·change`.
#[derive(Debug, Clone, Copy)]
pub struct Fill {
    pub first: [f32; 4],
    pub change: [f32; 4],
    /// `None`: solid.
    pub axis: Option<Axis>,
}

/// Affine position along a gradient axis; zero at its start and one at its end before padding.
#[derive(Debug, Clone, Copy)]
pub struct Axis {
    start: [f32; 2],
    delta: [f32; 2],
    /// `delta / |delta|²`; zero for an axis without length.
    direction: [f32; 2],
    offset: f32,
}

/// Shorter axes (in pixels²) have no direction: SVG paints the last stop.
const LEAST_AXIS: f32 = 1e-12;

impl Fill {
    /// Reads path `i` of `stops [n, 2, 4]` and `axis [n, 4]`.
    pub fn new(i: usize, stops: &[f32], axis: &[f32], gradient: bool) -> Self {
        let stop = |k: usize| std::array::from_fn(|c| stops[8 * i + 4 * k + c]);
        let (first, last): ([f32; 4], [f32; 4]) = (stop(0), stop(1));
        if !gradient {
            return Self { first, change: [0.0; 4], axis: None };
        }
        let a = &axis[4 * i..4 * i + 4];
        let change = std::array::from_fn(|c| last[c] - first[c]);
        Self { first, change, axis: Some(Axis::new([a[0], a[1]], [a[2] - a[0], a[3] - a[1]])) }
    }
}

impl Axis {
    fn new(start: [f32; 2], delta: [f32; 2]) -> Self {
        let square = delta[0] * delta[0] + delta[1] * delta[1];
        if square < LEAST_AXIS {
            return Self { start, delta: [0.0; 2], direction: [0.0; 2], offset: 1.0 };
        }
        let direction = [delta[0] / square, delta[1] / square];
        Self { start, delta, direction, offset: -(start[0] * direction[0] + start[1] * direction[1]) }
    }

    /// Unpadded positions of the pixel centres of a band's first column's lane, and the change from column to column.
    pub fn ramp(&self, top: usize, column: usize) -> (Lane, f32) {
        let x = column as f32 + 0.5;
        let lane = std::array::from_fn(|row| {
            let y = (top + row) as f32 + 0.5;
            self.offset + x * self.direction[0] + y * self.direction[1]
        });
        (lane, self.direction[0])
    }

    /// Gradient by the axis from moments of `e = ∂loss/∂position` over unpadded pixels.
    pub fn gradient(&self, moments: &Moments, top: usize) -> [f32; 4] {
        let [mut e, mut ex, mut ey, mut es] = [0.0_f32; 4];
        for row in 0..ROWS {
            let y = (top + row) as f32 + 0.5 - self.start[1];
            e += moments.e[row];
            ex += moments.ex[row] - moments.e[row] * self.start[0];
            ey += moments.e[row] * y;
            es += moments.es[row];
        }
        let square = self.delta[0] * self.delta[0] + self.delta[1] * self.delta[1];
        if square < LEAST_AXIS {
            return [0.0; 4];
        }
        // position = q·δ/|δ|², q = pixel − start, δ = end − start.
        let end = [0, 1].map(|k| [ex, ey][k] / square - 2.0 * es * self.direction[k]);
        [-end[0] - e * self.direction[0], -end[1] - e * self.direction[1], end[0], end[1]]
    }
}

/// Sums of `e`, `e·x` and `e·position` over a tile's columns, x at pixel centres.
#[derive(Debug, Clone, Copy)]
pub struct Moments {
    pub e: Lane,
    pub ex: Lane,
    pub es: Lane,
}

impl Moments {
    pub const ZERO: Self = Self { e: [0.0; ROWS], ex: [0.0; ROWS], es: [0.0; ROWS] };

    /// Adds one pixel of row `l`, at `x` and `position`.
    #[inline(always)]
    pub fn add(&mut self, l: usize, e: f32, x: f32, position: f32) {
        self.e[l] += e;
        self.ex[l] += e * x;
        self.es[l] += e * position;
    }
}
