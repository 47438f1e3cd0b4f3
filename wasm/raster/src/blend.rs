//! Blends a tile into the picture: `C ← C + α(c − C)`, in sRGB as browsers do.

use crate::fill::Fill;
use crate::saturate::resolve;
use crate::shade::{Place, Rgb, Shade};
use crate::walk::{Lane, ROWS};

/// Buffers of one tile, column by column.
#[derive(Debug)]
pub struct Columns<'a, const S: usize> {
    /// Differences of winding, resolved in passing.
    pub winding: &'a mut [[Lane; S]],
    /// Clip mask of the tile's columns.
    pub mask: Option<&'a [Lane]>,
    pub picture: &'a mut [Rgb],
    /// Takes the colour below the tile: un-compositing it later by `1/(1 − α)` would break on opaque paths.
    pub below: &'a mut [Rgb],
}

/// Resolves a tile's winding and blends it.
pub fn blend<const S: usize>(fill: &Fill, place: Place, columns: Columns<'_, S>) {
    match fill.axis {
        None => blend_with(Shade::<false>::new(fill, place), columns),
        Some(_) => blend_with(Shade::<true>::new(fill, place), columns),
    }
}

fn blend_with<const S: usize, const LINEAR: bool>(mut shade: Shade<LINEAR>, columns: Columns<'_, S>) {
    let mut running = [[0.0; ROWS]; S];
    let buffers = columns.winding.iter_mut().zip(columns.picture).zip(columns.below);
    for (i, ((winding, c), below)) in buffers.enumerate() {
        let mut covered = resolve(&mut running, winding);
        if let Some(mask) = columns.mask {
            covered = std::array::from_fn(|l| covered[l] * mask[i][l]);
        }
        *below = *c;
        for l in 0..ROWS {
            let s = shade.position(l);
            let alpha = covered[l] * shade.channel(3, s);
            for k in 0..3 {
                c[k][l] += alpha * (shade.channel(k, s) - c[k][l]);
            }
        }
        shade.advance();
    }
}

/// Rounds to 8 bits, as renderers store every blend.
pub fn quantise(picture: &mut [Rgb]) {
    for lane in picture.as_flattened_mut() {
        for v in lane {
            *v = (*v * 255.0).round_ties_even() * (1.0 / 255.0);
        }
    }
}
