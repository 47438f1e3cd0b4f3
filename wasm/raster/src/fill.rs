//! Solid and three-stop linear fills, as SVG paints them: padded, unpremultiplied, interpolated in sRGB.

use crate::lane::{Lane, ROWS, ZERO, rows};

/// Gradient of the loss by one path's fill.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct FillGradient {
    pub stops: [[f32; 4]; STOPS],
    pub axis: [f32; 4],
    /// Loss increase if the path were removed.
    pub importance: f64,
}

/// Stops of a gradient, evenly spaced along its axis.
pub const STOPS: usize = 3;

/// Colour and opacity along an axis, straight from stop to stop.
#[derive(Debug, Clone, Copy)]
pub struct Fill {
    pub stops: [[f32; 4]; STOPS],
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
    /// Reads path `i` of `stops [n, 3, 4]` and `axis [n, 4]`.
    pub fn new(i: usize, stops: &[f32], axis: &[f32], gradient: bool) -> Self {
        let stop = |k: usize| std::array::from_fn(|c| stops[4 * (STOPS * i + k) + c]);
        let a = &axis[4 * i..4 * i + 4];
        let axis = gradient.then(|| Axis::new([a[0], a[1]], [a[2] - a[0], a[3] - a[1]]));
        Self { stops: std::array::from_fn(stop), axis }
    }

    /// Channels over half `half` of the axis: value at position 0 and change per unit of position.
    pub fn half(&self, half: usize) -> ([f32; 4], [f32; 4]) {
        let (start, end) = (self.stops[half], self.stops[half + 1]);
        let change: [f32; 4] = std::array::from_fn(|k| 2.0 * (end[k] - start[k]));
        (std::array::from_fn(|k| start[k] - 0.5 * half as f32 * change[k]), change)
    }

    /// Unpadded positions of the pixel centres of a column, and the change from column to column; zero in a solid fill.
    pub fn ramp(&self, top: usize, column: usize) -> (Lane, f32) {
        self.axis.as_ref().map_or((ZERO, 0.0), |axis| axis.ramp(top, column))
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

    /// Unpadded position at a point.
    fn position(&self, x: f32, y: f32) -> f32 {
        self.offset + x * self.direction[0] + y * self.direction[1]
    }

    /// Least and greatest unpadded position in a band's columns `first..last`.
    pub fn range(&self, top: usize, first: usize, last: usize) -> (f32, f32) {
        let corner = |x: usize, row: usize| self.position(x as f32 + 0.5, (top + row) as f32 + 0.5);
        let corners =
            [(first, 0), (first, ROWS - 1), (last - 1, 0), (last - 1, ROWS - 1)].map(|(x, row)| corner(x, row));
        corners.into_iter().fold((f32::MAX, f32::MIN), |(low, high), s| (low.min(s), high.max(s)))
    }

    fn ramp(&self, top: usize, column: usize) -> (Lane, f32) {
        let start = self.position(column as f32 + 0.5, top as f32 + 0.5);
        ((rows() * self.direction[1]) + start, self.direction[0])
    }

    /// Gradient by the axis from moments of `e = ∂loss/∂position` over unpadded pixels.
    pub fn gradient(&self, moments: &Moments, top: usize) -> [f32; 4] {
        let square = self.delta[0] * self.delta[0] + self.delta[1] * self.delta[1];
        if square < LEAST_AXIS {
            return [0.0; 4];
        }
        let y = rows() + (top as f32 + 0.5 - self.start[1]);
        let (e, es) = (moments.e.reduce_add(), moments.es.reduce_add());
        let (ex, ey) = ((moments.ex - moments.e * self.start[0]).reduce_add(), (moments.e * y).reduce_add());
        // position = q·δ/|δ|², q = pixel − start, δ = end − start.
        let end = [0, 1].map(|k| [ex, ey][k] / square - 2.0 * es * self.direction[k]);
        [-end[0] - e * self.direction[0], -end[1] - e * self.direction[1], end[0], end[1]]
    }
}

/// Sums of `e`, `e·x` and `e·position` over columns, x at pixel centres.
#[derive(Debug, Clone, Copy)]
pub struct Moments {
    pub e: Lane,
    pub ex: Lane,
    pub es: Lane,
}

impl Moments {
    pub const ZERO: Self = Self { e: ZERO, ex: ZERO, es: ZERO };
}
