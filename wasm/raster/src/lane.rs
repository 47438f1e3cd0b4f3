//! The unit of storage: a vector of one value for each of a column's pixels in a band.
//!
//! A band is [`ROWS`] pixel rows of the frame. Inside it everything is stored by column, so that running sums along x, blends
//! and their gradients are plain vector operations without tails.

use wide::f32x16;

/// Pixel rows of a band: one 512-bit or two 256-bit vectors.
pub const ROWS: usize = 16;

/// One value for each of a column's pixels in a band.
pub type Lane = f32x16;

/// One column of colours, channel by channel.
pub type Rgb = [Lane; 3];

pub const ZERO: Lane = Lane::ZERO;

/// Number of every row.
pub fn rows() -> Lane {
    Lane::from(std::array::from_fn::<f32, ROWS, _>(|row| row as f32))
}

/// Empties a buffer and fills it anew, keeping its memory.
pub fn refill<T: Copy>(buffer: &mut Vec<T>, length: usize, value: T) {
    buffer.clear();
    buffer.resize(length, value);
}

/// Lengthens a buffer whose old values do not matter.
pub fn reserve<T: Copy>(buffer: &mut Vec<T>, length: usize, value: T) {
    if buffer.len() < length {
        buffer.resize(length, value);
    }
}

/// The smaller of two numbers that are not NaN; `f32::min` spends half its instructions on NaN.
#[inline(always)]
pub fn least(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

/// The larger of two numbers that are not NaN.
#[inline(always)]
pub fn most(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

/// A number that is not NaN, cut to a range.
#[inline(always)]
pub fn cut(v: f32, low: f32, high: f32) -> f32 {
    least(most(v, low), high)
}
