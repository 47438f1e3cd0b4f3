//! Forward and backward pass over one band of rows, while it is in cache.

use crate::composite::{Rgb, Upstream, blend, quantise, unblend};
use crate::cover::{Call, Cover};
use crate::fill::FillGradient;
use crate::gradient::add_path;
use crate::resolve::Overlap;
use crate::scene::{Frame, Objective};
use crate::seam::Seam;
use crate::transpose;
use crate::walk::{Lane, ROWS};

/// Gradients of the paths of one band, tile by tile from the top of the stack.
#[derive(Debug, Default)]
pub struct BandGradient {
    /// One loss a checkpoint.
    pub losses: Vec<f64>,
    pub paths: Vec<usize>,
    /// `[tiles, 3S, 2]`.
    pub points: Vec<f32>,
    pub fills: Vec<FillGradient>,
}

/// Buffers of a worker, reused from band to band.
#[derive(Debug, Default)]
pub struct Band {
    cover: Cover,
    /// The colour below every tile, as coverage is stored.
    below: Vec<Rgb>,
    picture: Vec<Rgb>,
    grad: Vec<Rgb>,
    curvature: Vec<Lane>,
    seams: Vec<Seam>,
}

impl Band {
    /// Composites the band at row `top` into `rows [≤ ROWS, width, 3]`.
    pub fn rasterize(&mut self, call: &Call<'_>, top: usize, rows: &mut [f32]) {
        self.begin(call, top);
        for i in 0..self.cover.tiles.len() {
            self.blend_tile(call, i);
        }
        self.write(call.frame, rows);
    }

    /// As `rasterize`, and carries the objective's gradient back to every path of the band.
    pub fn differentiate(
        &mut self,
        call: &Call<'_>,
        objective: &Objective<'_>,
        importance: bool,
        top: usize,
        rows: &mut [f32],
    ) -> BandGradient {
        self.begin(call, top);
        let losses = self.observe(call, objective);
        self.write(call.frame, rows);
        let mut gradient = BandGradient {
            losses,
            ..BandGradient::default()
        };
        self.unblend_tiles(call, importance, &mut gradient);
        self.differentiate_outlines(call, &mut gradient);
        gradient
    }

    /// Coverage of all paths, the last one's where they lie over each other, into `rows [≤ ROWS, width]`.
    pub fn coverage(&mut self, call: &Call<'_>, top: usize, rows: &mut [f32]) {
        self.cover.fill(call, top);
        let mut columns = vec![[0.0; ROWS]; call.frame.width];
        for tile in &self.cover.tiles {
            columns[tile.across()].copy_from_slice(&self.cover.coverage[tile.storage.clone()]);
        }
        transpose::write(&columns, call.frame.width, rows);
    }

    /// How often every path of the band lies over itself, path by path.
    pub fn overlaps(&mut self, call: &Call<'_>, top: usize) -> Vec<(usize, Overlap)> {
        self.cover.fill(call, top);
        self.cover.overlaps(call.frame)
    }

    fn begin(&mut self, call: &Call<'_>, top: usize) {
        self.cover.fill(call, top);
        self.below
            .resize(self.cover.coverage.len(), [[0.0; ROWS]; 3]);
        self.picture.clear();
        self.picture
            .resize(call.frame.width, call.frame.canvas.map(|v| [v; ROWS]));
        if call.frame.quantise {
            quantise(&mut self.picture);
        }
    }

    fn write(&self, frame: &Frame<'_>, rows: &mut [f32]) {
        transpose::write(self.picture.as_flattened(), 3 * frame.width, rows);
    }

    fn blend_tile(&mut self, call: &Call<'_>, i: usize) {
        let tile = &self.cover.tiles[i];
        let place = tile.place(self.cover.top);
        let coverage = &self.cover.coverage[tile.storage.clone()];
        let picture = &mut self.picture[tile.across()];
        blend(
            &tile.fill(call.paths),
            place,
            coverage,
            picture,
            &mut self.below[tile.storage.clone()],
        );
        if call.frame.quantise {
            quantise(picture);
        }
    }

    /// Composites bottom to top, stopping at every checkpoint to measure its loss.
    fn observe(&mut self, call: &Call<'_>, objective: &Objective<'_>) -> Vec<f64> {
        let mut next = 0;
        let mut losses = Vec::new();
        if let Objective::Checkpoints(checkpoints) = objective {
            self.seams.resize_with(checkpoints.len(), Seam::default);
            for (i, checkpoint) in checkpoints.iter().enumerate() {
                while next < self.cover.tiles.len()
                    && self.cover.tiles[next].path < checkpoint.below
                {
                    self.blend_tile(call, next);
                    next += 1;
                }
                losses.push(self.seams[i].observe(
                    checkpoint,
                    &self.picture,
                    call.frame,
                    self.cover.top,
                ));
            }
        }
        for i in next..self.cover.tiles.len() {
            self.blend_tile(call, i);
        }
        if let Objective::Upstream(grad_image) = objective {
            self.seams.resize_with(1, Seam::default);
            self.seams[0].receive(grad_image, call.paths.len(), call.frame, self.cover.top);
        }
        losses
    }

    /// Goes down the stack: turns coverage into its gradient and takes the gradients of fills.
    fn unblend_tiles(&mut self, call: &Call<'_>, importance: bool, out: &mut BandGradient) {
        self.grad.clear();
        self.grad.resize(call.frame.width, [[0.0; ROWS]; 3]);
        self.curvature.clear();
        self.curvature.resize(call.frame.width, [0.0; ROWS]);
        let mut seam = self.seams.len();
        for tile in self.cover.tiles.iter().rev() {
            while seam > 0 && self.seams[seam - 1].below > tile.path {
                seam -= 1;
                self.seams[seam].join(&mut self.grad, &mut self.curvature);
            }
            let coverage = &mut self.cover.coverage[tile.storage.clone()];
            let curvature = importance.then_some(&mut self.curvature[tile.across()]);
            let upstream = Upstream {
                grad: &mut self.grad[tile.across()],
                curvature,
            };
            let place = tile.place(self.cover.top);
            let below = &self.below[tile.storage.clone()];
            out.fills.push(unblend(
                &tile.fill(call.paths),
                place,
                coverage,
                below,
                upstream,
            ));
            out.paths.push(tile.path);
        }
        self.cover.apply_clips(call);
    }

    fn differentiate_outlines(&mut self, call: &Call<'_>, out: &mut BandGradient) {
        self.cover.grad_winding(call.frame.subrows);
        let stride = call.paths.segments * 6;
        out.points.resize(self.cover.tiles.len() * stride, 0.0);
        for (tile, grad_points) in self
            .cover
            .tiles
            .iter()
            .rev()
            .zip(out.points.chunks_exact_mut(stride))
        {
            add_path(call.chords, &self.cover.boundary(tile), grad_points);
        }
    }
}
