//! Turns control points and fills into pixels, and pixel errors into exact gradients.
//!
//! Coverage is the exact signed area of flattened outlines (box filter, nonzero rule); paths are blended in sRGB as browsers
//! do; gradients of outlines are boundary integrals of the pixel gradients. Everything is done band by band, in cache, and
//! bands are summed in order: the same bits whatever the number of threads.

// Lanes of several arrays advance together by one index; zipped iterators would hide the formulae and the vector code alike.
#![allow(clippy::needless_range_loop)]

mod adam;
mod band;
mod bins;
mod blend;
mod clip;
mod contour;
mod cover;
mod energy;
mod error;
mod facets;
mod fill;
mod flatten;
mod gradient;
mod lane;
mod line;
mod marks;
mod outlines;
mod sample;
mod saturate;
mod scene;
mod seam;
mod shade;
mod target;
mod threads;
mod transpose;
mod unblend;
mod walk;

pub use adam::{Adam, Rule};
use band::{Band, BandGradient};
pub use contour::{Component, contour};
use cover::Call;
pub use energy::coherent_energy;
pub use error::Error;
pub use fill::STOPS;
use lane::ROWS;
pub use saturate::Overlap;
use scene::check_heights;
pub use scene::{Checkpoint, Frame, MAX_COORDINATE, MAX_PATHS, MAX_SEGMENTS, MAX_SIDE, Objective, Paths, Sample};
pub use target::Target;

/// Below the noise of 8-bit edges, in pixels.
pub const FLATNESS: f32 = 0.05;

/// Losses, picture and gradients of one call; shapes as in [`Paths`].
#[derive(Debug, Clone, PartialEq)]
pub struct Gradients {
    /// One loss a checkpoint.
    pub losses: Vec<f64>,
    /// The finished picture, `[height, width, 3]`; empty unless asked for.
    pub image: Vec<f32>,
    pub points: Vec<f32>,
    pub stops: Vec<f32>,
    pub axis: Vec<f32>,
    /// Exact increase of the summed losses if a path were removed, `[n]`; zeros unless asked for.
    pub importance: Vec<f64>,
}

/// What a caller of [`differentiate`] wants beside losses and gradients.
#[derive(Debug, Clone, Copy, Default)]
pub struct Extras {
    /// Each path's exact leave-one-out loss, by `½·∂²loss/∂C²` carried down the stack.
    pub importance: bool,
    /// Black in bands that are left out.
    pub picture: bool,
    pub bands: Sample,
}

/// Paints the paths over the canvas, `[height, width, 3]`; `threads` 0 means all cores.
pub fn rasterize(paths: &Paths<'_>, frame: &Frame<'_>, threads: usize) -> Result<Vec<f32>, Error> {
    rasterize_stack(paths, frame, &[paths.len()], threads)
}

/// Pictures of the lowest paths, `[heights, height, width, 3]`: as many paths as each of the ascending `heights` says.
pub fn rasterize_stack(
    paths: &Paths<'_>,
    frame: &Frame<'_>,
    heights: &[usize],
    threads: usize,
) -> Result<Vec<f32>, Error> {
    frame.check()?;
    paths.check(frame)?;
    frame.check_clips()?;
    check_heights(heights.iter().copied(), paths.len())?;
    let call = Call::new(paths, frame, false);
    Ok(match frame.subrows {
        1 => rasterize_bands::<1>(&call, heights, threads),
        2 => rasterize_bands::<2>(&call, heights, threads),
        _ => rasterize_bands::<4>(&call, heights, threads),
    })
}

/// Paints the paths as resvg does, `[height, width, 3]`: outlines sampled four by four times a pixel, blends rounded to 8 bits.
///
/// The frame's sub-rows, flatness and rounding are resvg's own whatever it says.
pub fn preview(paths: &Paths<'_>, frame: &Frame<'_>, threads: usize) -> Result<Vec<f32>, Error> {
    frame.check()?;
    paths.check(frame)?;
    frame.check_clips()?;
    let frame = Frame { subrows: 4, quantise: true, ..*frame };
    Ok(rasterize_bands::<4>(&Call::new(paths, &frame, true), &[paths.len()], threads))
}

fn rasterize_bands<const S: usize>(call: &Call<'_>, heights: &[usize], threads: usize) -> Vec<f32> {
    let (row, rows) = (call.frame.width * 3, call.frame.height);
    let mut images = vec![0.0; heights.len() * rows * row];
    let mut bands: Vec<Vec<&mut [f32]>> = (0..rows.div_ceil(ROWS)).map(|_| Vec::new()).collect();
    for image in images.chunks_mut(rows * row) {
        for (band, rows) in bands.iter_mut().zip(image.chunks_mut(ROWS * row)) {
            band.push(rows);
        }
    }
    threads::map_ordered(
        threads,
        || call.outlines.prepare(),
        bands.into_iter().enumerate(),
        |band: &mut Band<S>, (i, images)| band.rasterize(call, i * ROWS, heights, images),
    );
    images
}

/// Paints the paths and differentiates the objective by every parameter of every path.
pub fn differentiate(
    paths: &Paths<'_>,
    frame: &Frame<'_>,
    objective: &Objective<'_>,
    extras: Extras,
    threads: usize,
) -> Result<Gradients, Error> {
    frame.check()?;
    paths.check(frame)?;
    objective.check(paths.len(), frame)?;
    extras.bands.check()?;
    let call = Call::new(paths, frame, false);
    let found = match frame.subrows {
        1 => differentiate_bands::<1>(&call, objective, extras, threads),
        2 => differentiate_bands::<2>(&call, objective, extras, threads),
        _ => differentiate_bands::<4>(&call, objective, extras, threads),
    };
    // A mask that is not finite makes a loss or a gradient so too, and sound ones need not be searched in every pass.
    let sums = found.losses.iter().copied().chain(found.stops.iter().copied().map(f64::from));
    if !sums.sum::<f64>().is_finite() {
        frame.check_clips()?;
    }
    Ok(found)
}

fn differentiate_bands<const S: usize>(
    call: &Call<'_>,
    objective: &Objective<'_>,
    extras: Extras,
    threads: usize,
) -> Gradients {
    let values = if extras.picture { call.frame.width * call.frame.height * 3 } else { 0 };
    let mut image = vec![0.0; values];
    let mut rows = image.chunks_mut(ROWS * call.frame.width * 3);
    let bands = (0..call.frame.height.div_ceil(ROWS)).map(|i| (i, rows.next()));
    let Sample { every, first } = extras.bands;
    let parts = threads::map_ordered(
        threads,
        || call.outlines.prepare(),
        bands.skip(first).step_by(every),
        |band: &mut Band<S>, (i, rows)| band.differentiate(call, objective, extras.importance, i * ROWS, rows),
    );
    sum(call.paths, objective.n_losses(), image, &parts, every)
}

/// Coverage of one closed chain of cubics `[3S, 2]`, `[height, width]`, resolved over 4 sub-rows a pixel.
pub fn coverage(points: &[f32], width: usize, height: usize) -> Result<Vec<f32>, Error> {
    let frame = Frame { width, height, canvas: [0.0; 3], clips: &[], subrows: 4, flatness: FLATNESS, quantise: false };
    let paths = Paths {
        segments: points.len() / 6,
        points,
        stops: &[1.0; 4 * STOPS],
        axis: &[0.0; 4],
        gradient: &[false],
        clip: &[-1],
    };
    let white_on_black = rasterize(&paths, &frame, 1)?;
    Ok(white_on_black.as_chunks::<3>().0.iter().map(|rgb| rgb[0]).collect())
}

/// How each path lies over itself, `[n]`; `threads` 0 means all cores.
pub fn overlaps(paths: &Paths<'_>, frame: &Frame<'_>, threads: usize) -> Result<Vec<Overlap>, Error> {
    frame.check()?;
    paths.check(frame)?;
    let call = Call::new(paths, frame, false);
    let bands = 0..frame.height.div_ceil(ROWS);
    let parts = threads::map_ordered(
        threads,
        || call.outlines.prepare(),
        bands,
        |band: &mut Band<4>, i| band.overlaps(&call, i * ROWS),
    );
    let mut whole = vec![Overlap::default(); paths.len()];
    for (path, part) in parts.into_iter().flatten() {
        whole[path].covered += part.covered;
        whole[path].folded += part.folded;
        whole[path].reversed += part.reversed;
    }
    Ok(whole)
}

/// Adds the bands' gradients, each of which stands for `every` bands, in their order.
fn sum(paths: &Paths<'_>, n_losses: usize, image: Vec<f32>, parts: &[BandGradient], every: usize) -> Gradients {
    let (n, stride) = (paths.len(), paths.segments * 6);
    let mut whole = Gradients {
        losses: vec![0.0; n_losses],
        image,
        points: vec![0.0; n * stride],
        stops: vec![0.0; n * 4 * STOPS],
        axis: vec![0.0; n * 4],
        importance: vec![0.0; n],
    };
    for part in parts {
        for (loss, share) in whole.losses.iter_mut().zip(&part.losses) {
            *loss += every as f64 * share;
        }
        for ((&path, fill), points) in part.paths.iter().zip(&part.fills).zip(part.points.chunks_exact(stride)) {
            add(&mut whole.points[path * stride..], points, every as f32);
            add(&mut whole.stops[path * 4 * STOPS..], fill.stops.as_flattened(), every as f32);
            add(&mut whole.axis[path * 4..], &fill.axis, every as f32);
            whole.importance[path] += every as f64 * fill.importance;
        }
    }
    whole
}

fn add(whole: &mut [f32], part: &[f32], times: f32) {
    for (w, p) in whole.iter_mut().zip(part) {
        *w += times * p;
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, clippy::expect_used)] // a failed unwrap is a failed test
mod tests;
