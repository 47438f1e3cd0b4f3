//! Colour and opacity of a fill over columns of a band, and what their gradients add up to.
//!
//! Three kinds of columns: all of one stop's colour, between the stops everywhere, or some of both.

use crate::fill::{Fill, Moments};
use crate::lane::{Lane, ZERO};
use std::ops::Range;

/// Gradients by a fill's stops, row by row, and moments for its axis.
#[derive(Debug, Clone, Copy)]
pub struct Totals {
    pub stops: [[Lane; 4]; 2],
    pub moments: Moments,
}

impl Totals {
    pub const ZERO: Self = Self { stops: [[ZERO; 4]; 2], moments: Moments::ZERO };
}

/// A fill that walks along with columns.
pub trait Shade: Copy {
    /// Sums over columns.
    type Sums: Copy;
    const NOTHING: Self::Sums;

    /// Channel `k` (3: opacity) of this column.
    fn channel(&self, k: usize) -> Lane;

    /// Goes on to the next column.
    fn advance(&mut self);

    /// Adds this column's `∂loss/∂channel`.
    fn add(&self, sums: &mut Self::Sums, grad: [Lane; 4]);

    /// Adds the sums over columns of which `self` was the first.
    fn total(&self, sums: &Self::Sums, totals: &mut Totals);
}

/// What a fill does over some columns.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Kind {
    /// All of a stop's colour: the first's or the last's.
    Even(usize),
    Ramp,
    Padded,
}

impl Kind {
    /// Looks at the corners of some columns, at least one, of the band at row `top`.
    pub fn new(fill: &Fill, top: usize, columns: &Range<usize>) -> Self {
        let Some(axis) = &fill.axis else { return Self::Even(0) };
        match axis.range(top, columns.start, columns.end) {
            (_, high) if high <= 0.0 => Self::Even(0),
            (low, _) if low >= 1.0 => Self::Even(1),
            (low, high) if low >= 0.0 && high <= 1.0 => Self::Ramp,
            _ => Self::Padded,
        }
    }
}

/// Evaluates an expression with the shade of a fill over some columns, compiled for each of the kinds.
macro_rules! with_shade {
    (($fill:expr, $top:expr, $columns:expr), $shade:ident => $call:expr) => {
        match $crate::shade::Kind::new($fill, $top, $columns) {
            $crate::shade::Kind::Even(stop) => {
                let $shade = $crate::shade::Even::new($fill, stop);
                $call
            }
            $crate::shade::Kind::Ramp => {
                let $shade = $crate::shade::Ramp::new($fill, $top, $columns.start);
                $call
            }
            $crate::shade::Kind::Padded => {
                let $shade = $crate::shade::Padded::new($fill, $top, $columns.start);
                $call
            }
        }
    };
}
pub(crate) use with_shade;

/// A solid fill, or columns beyond one end of the axis.
#[derive(Debug, Clone, Copy)]
pub struct Even {
    channels: [Lane; 4],
    stop: usize,
}

impl Even {
    pub fn new(fill: &Fill, stop: usize) -> Self {
        Self { channels: [fill.first, fill.last][stop].map(Lane::splat), stop }
    }
}

impl Shade for Even {
    type Sums = [Lane; 4];
    const NOTHING: Self::Sums = [ZERO; 4];

    #[inline(always)]
    fn channel(&self, k: usize) -> Lane {
        self.channels[k]
    }

    #[inline(always)]
    fn advance(&mut self) {}

    #[inline(always)]
    fn add(&self, sums: &mut Self::Sums, grad: [Lane; 4]) {
        for k in 0..4 {
            sums[k] += grad[k];
        }
    }

    #[inline(always)]
    fn total(&self, sums: &Self::Sums, totals: &mut Totals) {
        for k in 0..4 {
            totals.stops[self.stop][k] += sums[k];
        }
    }
}

/// Columns between the stops: channels change by the same amount from column to column.
#[derive(Debug, Clone, Copy)]
pub struct Ramp {
    channels: [Lane; 4],
    steps: [Lane; 4],
    /// From the first stop to the last.
    change: [Lane; 4],
    position: Lane,
    step: Lane,
    /// Of the first column's pixel centres.
    x: f32,
    /// Columns since the first.
    passed: Lane,
}

impl Ramp {
    pub fn new(fill: &Fill, top: usize, column: usize) -> Self {
        let (position, step) = fill.ramp(top, column);
        let change: [Lane; 4] = std::array::from_fn(|k| Lane::splat(fill.last[k] - fill.first[k]));
        Self {
            channels: std::array::from_fn(|k| position.mul_add(change[k], Lane::splat(fill.first[k]))),
            steps: change.map(|change| change * step),
            change,
            position,
            step: Lane::splat(step),
            x: column as f32 + 0.5,
            passed: ZERO,
        }
    }
}

/// Sums of channel gradients, and of them times the columns passed.
#[derive(Debug, Clone, Copy)]
pub struct RampSums {
    plain: [Lane; 4],
    passed: [Lane; 4],
}

impl Shade for Ramp {
    type Sums = RampSums;
    const NOTHING: Self::Sums = RampSums { plain: [ZERO; 4], passed: [ZERO; 4] };

    #[inline(always)]
    fn channel(&self, k: usize) -> Lane {
        self.channels[k]
    }

    #[inline(always)]
    fn advance(&mut self) {
        for k in 0..4 {
            self.channels[k] += self.steps[k];
        }
        self.passed += Lane::ONE;
    }

    #[inline(always)]
    fn add(&self, sums: &mut Self::Sums, grad: [Lane; 4]) {
        for k in 0..4 {
            sums.plain[k] += grad[k];
            sums.passed[k] = grad[k].mul_add(self.passed, sums.passed[k]);
        }
    }

    /// Position is affine in x, so sums with it follow from sums with x.
    #[inline(always)]
    fn total(&self, sums: &Self::Sums, totals: &mut Totals) {
        for k in 0..4 {
            let (plain, passed) = (sums.plain[k], sums.passed[k]);
            let by_position = self.position * plain + self.step * passed;
            totals.stops[0][k] += plain - by_position;
            totals.stops[1][k] += by_position;
            totals.moments.e += self.change[k] * plain;
            totals.moments.ex += self.change[k] * (passed + plain * self.x);
            totals.moments.es += self.change[k] * by_position;
        }
    }
}

/// Columns of which some pixels lie beyond the ends of the axis.
#[derive(Debug, Clone, Copy)]
pub struct Padded {
    first: [Lane; 4],
    change: [Lane; 4],
    /// Unpadded.
    position: Lane,
    step: f32,
    x: f32,
}

impl Padded {
    pub fn new(fill: &Fill, top: usize, column: usize) -> Self {
        let (position, step) = fill.ramp(top, column);
        Self {
            first: fill.first.map(Lane::splat),
            change: std::array::from_fn(|k| Lane::splat(fill.last[k] - fill.first[k])),
            position,
            step,
            x: column as f32 + 0.5,
        }
    }

    #[inline(always)]
    fn padded(&self) -> Lane {
        self.position.fast_clamp(ZERO, Lane::ONE)
    }
}

impl Shade for Padded {
    type Sums = Totals;
    const NOTHING: Self::Sums = Totals::ZERO;

    #[inline(always)]
    fn channel(&self, k: usize) -> Lane {
        self.padded().mul_add(self.change[k], self.first[k])
    }

    #[inline(always)]
    fn advance(&mut self) {
        self.position += self.step;
        self.x += 1.0;
    }

    /// `stops[0]` takes the gradients themselves until they are totalled.
    #[inline(always)]
    fn add(&self, sums: &mut Self::Sums, grad: [Lane; 4]) {
        let position = self.padded();
        let mut e = ZERO;
        for k in 0..4 {
            sums.stops[0][k] += grad[k];
            sums.stops[1][k] = grad[k].mul_add(position, sums.stops[1][k]);
            e = grad[k].mul_add(self.change[k], e);
        }
        let within = self.position.simd_ge(ZERO) & self.position.simd_le(Lane::ONE);
        let e = e & within;
        sums.moments.e += e;
        sums.moments.ex = e.mul_add(Lane::splat(self.x), sums.moments.ex);
        sums.moments.es = e.mul_add(position, sums.moments.es);
    }

    #[inline(always)]
    fn total(&self, sums: &Self::Sums, totals: &mut Totals) {
        for k in 0..4 {
            totals.stops[0][k] += sums.stops[0][k] - sums.stops[1][k];
            totals.stops[1][k] += sums.stops[1][k];
        }
        totals.moments.e += sums.moments.e;
        totals.moments.ex += sums.moments.ex;
        totals.moments.es += sums.moments.es;
    }
}
