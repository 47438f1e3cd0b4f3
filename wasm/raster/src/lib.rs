//! Turns control points and fills into pixels, and pixel errors into exact gradients.
//!
//! Coverage is the exact signed area of flattened outlines (box filter, nonzero rule); paths are blended in sRGB as browsers
//! do; gradients of outlines are boundary integrals of the pixel gradients. Everything is done band by band, in cache, and
//! bands are summed in order: the same bits whatever the number of threads.

// Lanes of several arrays advance together by one index; zipped iterators would hide the formulae and the vector code alike.
#![allow(clippy::needless_range_loop)]

mod band;
mod clip;
mod composite;
mod cover;
mod error;
mod fill;
mod flatten;
mod gradient;
mod resolve;
mod scene;
mod seam;
mod threads;
mod transpose;
mod walk;

use band::{Band, BandGradient};
use cover::Call;
pub use error::Error;
pub use resolve::Overlap;
pub use scene::{
    Checkpoint, Frame, MAX_COORDINATE, MAX_PATHS, MAX_SEGMENTS, MAX_SIDE, Objective, Paths,
};
use walk::ROWS;

/// Losses, picture and gradients of one call; shapes as in [`Paths`].
#[derive(Debug, Clone, PartialEq)]
pub struct Gradients {
    /// One loss a checkpoint.
    pub losses: Vec<f64>,
    /// The finished picture, `[height, width, 3]`.
    pub image: Vec<f32>,
    pub points: Vec<f32>,
    pub stops: Vec<f32>,
    pub axis: Vec<f32>,
    /// Exact increase of the summed losses if a path were removed, `[n]`; zeros unless asked for.
    pub importance: Vec<f64>,
}

/// Paints the paths over the canvas, `[height, width, 3]`; `threads` 0 means all cores.
pub fn rasterize(paths: &Paths<'_>, frame: &Frame<'_>, threads: usize) -> Result<Vec<f32>, Error> {
    frame.check()?;
    paths.check(frame)?;
    let chords = flatten::flatten(paths);
    let call = Call {
        paths,
        frame,
        chords: &chords,
    };
    let mut image = vec![0.0; frame.width * frame.height * 3];
    let bands = image.chunks_mut(ROWS * frame.width * 3).enumerate();
    threads::map_ordered(threads, bands, |band: &mut Band, (i, rows)| {
        band.rasterize(&call, i * ROWS, rows)
    });
    Ok(image)
}

/// Paints the paths and differentiates the objective by every parameter of every path.
///
/// `importance` also measures each path's exact leave-one-out loss, by `½·∂²loss/∂C²` carried down the stack.
pub fn differentiate(
    paths: &Paths<'_>,
    frame: &Frame<'_>,
    objective: &Objective<'_>,
    importance: bool,
    threads: usize,
) -> Result<Gradients, Error> {
    frame.check()?;
    paths.check(frame)?;
    objective.check(paths.len(), frame)?;
    let chords = flatten::flatten(paths);
    let call = Call {
        paths,
        frame,
        chords: &chords,
    };
    let mut image = vec![0.0; frame.width * frame.height * 3];
    let bands = image.chunks_mut(ROWS * frame.width * 3).enumerate();
    let parts = threads::map_ordered(threads, bands, |band: &mut Band, (i, rows)| {
        band.differentiate(&call, objective, importance, i * ROWS, rows)
    });
    let n_losses = if let Objective::Checkpoints(checkpoints) = objective {
        checkpoints.len()
    } else {
        0
    };
    Ok(sum(paths, n_losses, image, &parts))
}

/// Coverage of one closed chain of cubics `[3S, 2]`, `[height, width]`, resolved over 4 sub-rows a pixel.
pub fn coverage(points: &[f32], width: usize, height: usize) -> Result<Vec<f32>, Error> {
    let frame = Frame {
        width,
        height,
        canvas: [0.0; 3],
        clips: &[],
        subrows: 4,
        quantise: false,
    };
    let (stops, axis) = ([0.0; 8], [0.0; 4]);
    let paths = Paths {
        segments: points.len() / 6,
        points,
        stops: &stops,
        axis: &axis,
        gradient: &[false],
        clip: &[-1],
    };
    frame.check()?;
    paths.check(&frame)?;
    let chords = flatten::flatten(&paths);
    let call = Call {
        paths: &paths,
        frame: &frame,
        chords: &chords,
    };
    let mut mask = vec![0.0; width * height];
    let mut band = Band::default();
    for (i, rows) in mask.chunks_mut(ROWS * width).enumerate() {
        band.coverage(&call, i * ROWS, rows);
    }
    Ok(mask)
}

/// How far each path lies over itself, in pixel areas, `[n]`; `threads` 0 means all cores.
pub fn overlaps(
    paths: &Paths<'_>,
    frame: &Frame<'_>,
    threads: usize,
) -> Result<Vec<Overlap>, Error> {
    frame.check()?;
    paths.check(frame)?;
    let chords = flatten::flatten(paths);
    let call = Call {
        paths,
        frame,
        chords: &chords,
    };
    let bands = 0..frame.height.div_ceil(ROWS);
    let parts = threads::map_ordered(threads, bands, |band: &mut Band, i| {
        band.overlaps(&call, i * ROWS)
    });
    let mut whole = vec![Overlap::default(); paths.len()];
    for (path, part) in parts.into_iter().flatten() {
        whole[path].covered += part.covered;
        whole[path].folded += part.folded;
        whole[path].reversed += part.reversed;
    }
    Ok(whole)
}

/// Adds the bands' gradients in their order.
fn sum(paths: &Paths<'_>, n_losses: usize, image: Vec<f32>, parts: &[BandGradient]) -> Gradients {
    let (n, stride) = (paths.len(), paths.segments * 6);
    let mut whole = Gradients {
        losses: vec![0.0; n_losses],
        image,
        points: vec![0.0; n * stride],
        stops: vec![0.0; n * 8],
        axis: vec![0.0; n * 4],
        importance: vec![0.0; n],
    };
    for part in parts {
        for (loss, share) in whole.losses.iter_mut().zip(&part.losses) {
            *loss += share;
        }
        for ((&path, fill), points) in part
            .paths
            .iter()
            .zip(&part.fills)
            .zip(part.points.chunks_exact(stride))
        {
            add(&mut whole.points[path * stride..], points);
            add(&mut whole.stops[path * 8..], fill.stops.as_flattened());
            add(&mut whole.axis[path * 4..], &fill.axis);
            whole.importance[path] += fill.importance;
        }
    }
    whole
}

fn add(whole: &mut [f32], part: &[f32]) {
    for (w, p) in whole.iter_mut().zip(part) {
        *w += p;
    }
}
