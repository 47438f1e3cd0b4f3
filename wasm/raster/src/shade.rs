//! Colour and opacity of a fill over columns of a band, and what their gradients add up to.
//!
//! Three kinds of columns: all of an end's colour, between the same two stops everywhere, or some of both.

use crate::fill::{Fill, Moments, STOPS};
use crate::lane::{Lane, ZERO};
use std::ops::Range;

/// Gradients by a fill's stops, row by row, and moments for its axis.
#[derive(Debug, Clone, Copy)]
pub struct Totals {
    pub stops: [[Lane; 4]; STOPS],
    pub moments: Moments,
}

impl Totals {
    pub const ZERO: Self = Self { stops: [[ZERO; 4]; STOPS], moments: Moments::ZERO };
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
    /// Within one half of the axis.
    Ramp(usize),
    Padded,
}

impl Kind {
    /// Looks at the corners of some columns, at least one, of the band at row `top`.
    pub fn new(fill: &Fill, top: usize, columns: &Range<usize>) -> Self {
        let Some(axis) = &fill.axis else { return Self::Even(0) };
        match axis.range(top, columns.start, columns.end) {
            (_, high) if high <= 0.0 => Self::Even(0),
            (low, _) if low >= 1.0 => Self::Even(STOPS - 1),
            (low, high) if low >= 0.0 && high <= 0.5 => Self::Ramp(0),
            (low, high) if low >= 0.5 && high <= 1.0 => Self::Ramp(1),
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
            $crate::shade::Kind::Ramp(half) => {
                let $shade = $crate::shade::Ramp::new($fill, half, $top, $columns.start);
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
        Self { channels: fill.stops[stop].map(Lane::splat), stop }
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

/// Columns within a half of the axis: channels change by the same amount from column to column.
#[derive(Debug, Clone, Copy)]
pub struct Ramp {
    channels: [Lane; 4],
    steps: [Lane; 4],
    half: usize,
    /// Per unit of position.
    change: [Lane; 4],
    position: Lane,
    step: Lane,
    /// Of the first column's pixel centres.
    x: f32,
    /// Columns since the first.
    passed: Lane,
}

impl Ramp {
    pub fn new(fill: &Fill, half: usize, top: usize, column: usize) -> Self {
        let (position, step) = fill.ramp(top, column);
        let (base, change) = fill.half(half);
        let change = change.map(Lane::splat);
        Self {
            half,
            channels: std::array::from_fn(|k| position.mul_add(change[k], Lane::splat(base[k]))),
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
            let at_end = (by_position - plain * (0.5 * self.half as f32)) * 2.0;
            totals.stops[self.half][k] += plain - at_end;
            totals.stops[self.half + 1][k] += at_end;
            totals.moments.e += self.change[k] * plain;
            totals.moments.ex += self.change[k] * (passed + plain * self.x);
            totals.moments.es += self.change[k] * by_position;
        }
    }
}

/// Columns of which some pixels lie beyond the ends of the axis, or on both sides of its middle.
#[derive(Debug, Clone, Copy)]
pub struct Padded {
    first: [Lane; 4],
    /// Per unit of position in either half.
    change: [[Lane; 4]; 2],
    /// Unpadded.
    position: Lane,
    step: f32,
    x: f32,
}

impl Padded {
    pub fn new(fill: &Fill, top: usize, column: usize) -> Self {
        let (position, step) = fill.ramp(top, column);
        Self {
            first: fill.stops[0].map(Lane::splat),
            change: [0, 1].map(|half| fill.half(half).1.map(Lane::splat)),
            position,
            step,
            x: column as f32 + 0.5,
        }
    }

    /// How far into either half.
    #[inline(always)]
    fn padded(&self) -> [Lane; 2] {
        let half = Lane::splat(0.5);
        [self.position.fast_max(ZERO).fast_min(half), (self.position - half).fast_max(ZERO).fast_min(half)]
    }
}

/// Gradients by the channels, themselves and times the way into either half; moments.
#[derive(Debug, Clone, Copy)]
pub struct PaddedSums {
    plain: [Lane; 4],
    by_half: [[Lane; 4]; 2],
    moments: Moments,
}

impl Shade for Padded {
    type Sums = PaddedSums;
    const NOTHING: Self::Sums = PaddedSums { plain: [ZERO; 4], by_half: [[ZERO; 4]; 2], moments: Moments::ZERO };

    #[inline(always)]
    fn channel(&self, k: usize) -> Lane {
        let [a, b] = self.padded();
        b.mul_add(self.change[1][k], a.mul_add(self.change[0][k], self.first[k]))
    }

    #[inline(always)]
    fn advance(&mut self) {
        self.position += self.step;
        self.x += 1.0;
    }

    #[inline(always)]
    fn add(&self, sums: &mut Self::Sums, grad: [Lane; 4]) {
        let [a, b] = self.padded();
        let mut e = [ZERO; 2];
        for k in 0..4 {
            sums.plain[k] += grad[k];
            sums.by_half[0][k] = grad[k].mul_add(a, sums.by_half[0][k]);
            sums.by_half[1][k] = grad[k].mul_add(b, sums.by_half[1][k]);
            e[0] = grad[k].mul_add(self.change[0][k], e[0]);
            e[1] = grad[k].mul_add(self.change[1][k], e[1]);
        }
        let half = Lane::splat(0.5);
        let first = self.position.simd_ge(ZERO) & self.position.simd_le(half);
        let second = self.position.simd_gt(half) & self.position.simd_le(Lane::ONE);
        let e = (e[0] & first) + (e[1] & second);
        sums.moments.e += e;
        sums.moments.ex = e.mul_add(Lane::splat(self.x), sums.moments.ex);
        sums.moments.es = e.mul_add(self.position, sums.moments.es);
    }

    #[inline(always)]
    fn total(&self, sums: &Self::Sums, totals: &mut Totals) {
        for k in 0..4 {
            let [a, b] = [0, 1].map(|half| sums.by_half[half][k] * 2.0);
            totals.stops[0][k] += sums.plain[k] - a;
            totals.stops[1][k] += a - b;
            totals.stops[2][k] += b;
        }
        totals.moments.e += sums.moments.e;
        totals.moments.ex += sums.moments.ex;
        totals.moments.es += sums.moments.es;
    }
}
