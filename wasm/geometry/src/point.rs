//! Points of the plane, read as complex numbers where similarities are wanted.

use std::ops::{Add, AddAssign, Mul, Neg, Sub};

/// (x, y) in portrait pixels, y down.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Point {
    pub x: f64,
    pub y: f64,
}

impl Point {
    pub const ZERO: Self = Self { x: 0.0, y: 0.0 };

    #[must_use]
    pub const fn new(x: f64, y: f64) -> Self {
        Self { x, y }
    }

    #[must_use]
    pub fn dot(self, other: Self) -> f64 {
        self.x * other.x + self.y * other.y
    }

    /// z component of the cross product; positive when `other` lies clockwise of `self` on screen (y down).
    #[must_use]
    pub fn cross(self, other: Self) -> f64 {
        self.x * other.y - self.y * other.x
    }

    #[must_use]
    pub fn norm(self) -> f64 {
        self.dot(self).sqrt()
    }

    #[must_use]
    pub fn distance(self, other: Self) -> f64 {
        (self - other).norm()
    }

    #[must_use]
    pub fn lerp(self, other: Self, t: f64) -> Self {
        self + (other - self) * t
    }

    /// Product of complex numbers: turns `self` by the angle of `factor` and scales it by its norm.
    #[must_use]
    pub fn complex_mul(self, factor: Self) -> Self {
        Self::new(self.x * factor.x - self.y * factor.y, self.x * factor.y + self.y * factor.x)
    }

    /// Quotient of complex numbers; `divisor` must not be zero.
    #[must_use]
    pub fn complex_div(self, divisor: Self) -> Self {
        let conjugate = Self::new(divisor.x, -divisor.y);
        self.complex_mul(conjugate) * (1.0 / divisor.dot(divisor))
    }

    #[must_use]
    pub fn is_finite(self) -> bool {
        self.x.is_finite() && self.y.is_finite()
    }
}

impl Add for Point {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self::new(self.x + other.x, self.y + other.y)
    }
}

impl AddAssign for Point {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl Sub for Point {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self::new(self.x - other.x, self.y - other.y)
    }
}

impl Mul<f64> for Point {
    type Output = Self;
    fn mul(self, factor: f64) -> Self {
        Self::new(self.x * factor, self.y * factor)
    }
}

impl Neg for Point {
    type Output = Self;
    fn neg(self) -> Self {
        Self::new(-self.x, -self.y)
    }
}

/// Points of a flat `x, y, x, y, …` array; an odd last number is left out.
#[must_use]
pub fn from_flat(flat: &[f64]) -> Vec<Point> {
    flat.chunks_exact(2).map(|pair| Point::new(pair[0], pair[1])).collect()
}

/// Flat `x, y, x, y, …` array of points.
#[must_use]
pub fn to_flat(points: &[Point]) -> Vec<f64> {
    points.iter().flat_map(|point| [point.x, point.y]).collect()
}
