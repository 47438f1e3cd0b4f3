//! Blends a span of a tile into the picture: `C ← C + α(c − C)`, in sRGB as browsers do.

use crate::lane::{Lane, Rgb};
use crate::saturate::resolve;
use crate::shade::Shade;

/// The picture over some columns, and what keeps the colour below the tile: un-compositing it later by `1/(1 − α)` would break
/// on opaque paths.
#[derive(Debug)]
pub struct Canvas<'a> {
    pub picture: &'a mut [Rgb],
    pub below: &'a mut [Rgb],
}

/// What is rounded to 8 bits in a blend: nothing, or what tiny-skia rounds.
#[derive(Debug, Clone, Copy)]
pub enum Rounding {
    None,
    /// A solid fill is multiplied by its opacity before it is rounded.
    Solid,
    /// The colours of a gradient are rounded, and multiplied by their opacities as bytes.
    Gradient,
}

impl Rounding {
    #[inline(always)]
    fn blend(self, shade: &impl Shade, covered: Lane, c: &mut Rgb) {
        match self {
            Self::None => blend_column(shade, covered, c),
            Self::Solid => blend_bytes(shade, covered, c, |colour| (colour * shade.channel(3) + 0.5).floor()),
            Self::Gradient => blend_bytes(shade, covered, c, |colour| product(colour * bytes(shade.channel(3)))),
        }
    }
}

/// Blends edge columns, resolving their windings in passing; `running` is the winding left of them, zero.
pub fn blend_edges<const S: usize>(
    mut shade: impl Shade,
    running: &mut [Lane; S],
    winding: &mut [[Lane; S]],
    mask: Option<&[Lane]>,
    canvas: Canvas<'_>,
    rounding: Rounding,
) {
    let mut sums = *running; // a local keeps them in registers
    let columns = winding.iter_mut().zip(canvas.picture).zip(canvas.below);
    for (i, ((winding, c), below)) in columns.enumerate() {
        let covered = resolve(&mut sums, winding);
        let covered = mask.map_or(covered, |mask| covered * mask[i]);
        *below = *c;
        rounding.blend(&shade, covered, c);
        shade.advance();
    }
    *running = sums;
}

/// Blends columns of the same coverage.
pub fn blend_flat(mut shade: impl Shade, covered: Lane, canvas: Canvas<'_>, rounding: Rounding) {
    for (c, below) in canvas.picture.iter_mut().zip(canvas.below) {
        *below = *c;
        rounding.blend(&shade, covered, c);
        shade.advance();
    }
}

#[inline(always)]
fn blend_column(shade: &impl Shade, covered: Lane, c: &mut Rgb) {
    let alpha = covered * shade.channel(3);
    for k in 0..3 {
        c[k] = alpha.mul_add(shade.channel(k) - c[k], c[k]);
    }
}

/// Rounds to 8 bits, as renderers store a picture.
pub fn quantise(picture: &mut [Rgb]) {
    for lane in picture.as_flattened_mut() {
        *lane = bytes(*lane) * (1.0 / 255.0);
    }
}

/// Values in [0, 1] in 255ths.
#[inline(always)]
fn bytes(v: Lane) -> Lane {
    (v * 255.0 + 0.5).floor()
}

/// A product of two bytes as a byte, as tiny-skia divides by 255: never down, half a step up on the mean.
#[inline(always)]
fn product(v: Lane) -> Lane {
    ((v + 255.0) * (1.0 / 256.0)).floor()
}

/// `blend_column` in the bytes of tiny-skia's `lowp` pipeline: an opaque fill is mixed with the picture, another is multiplied
/// by its coverage and laid over it.
#[inline(always)]
fn blend_bytes(shade: &impl Shade, covered: Lane, c: &mut Rgb, premultiply: impl Fn(Lane) -> Lane) {
    let (covered, opacity) = (bytes(covered), bytes(shade.channel(3)));
    let through = 255.0 - product(opacity * covered);
    let opaque = opacity.simd_eq(Lane::splat(255.0));
    for k in 0..3 {
        let (colour, below) = (bytes(shade.channel(k)), bytes(c[k]));
        let mixed = product(below.mul_add(255.0 - covered, colour * covered));
        let laid = product(premultiply(colour) * covered) + product(below * through);
        c[k] = opaque.select(mixed, laid) * (1.0 / 255.0);
    }
}
