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

/// Blends edge columns, resolving their windings in passing; `running` is the winding left of them, zero.
pub fn blend_edges<const S: usize>(
    mut shade: impl Shade,
    running: &mut [Lane; S],
    winding: &mut [[Lane; S]],
    mask: Option<&[Lane]>,
    canvas: Canvas<'_>,
) {
    let mut sums = *running; // a local keeps them in registers
    let columns = winding.iter_mut().zip(canvas.picture).zip(canvas.below);
    for (i, ((winding, c), below)) in columns.enumerate() {
        let covered = resolve(&mut sums, winding);
        let covered = mask.map_or(covered, |mask| covered * mask[i]);
        *below = *c;
        blend_column(&shade, covered, c);
        shade.advance();
    }
    *running = sums;
}

/// Blends columns of the same coverage.
pub fn blend_flat(mut shade: impl Shade, covered: Lane, canvas: Canvas<'_>) {
    for (c, below) in canvas.picture.iter_mut().zip(canvas.below) {
        *below = *c;
        blend_column(&shade, covered, c);
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

/// Rounds to 8 bits, as renderers store every blend.
pub fn quantise(picture: &mut [Rgb]) {
    for lane in picture.as_flattened_mut() {
        *lane = (*lane * 255.0).round_ties_even() * (1.0 / 255.0);
    }
}
