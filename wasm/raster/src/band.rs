//! Forward and backward pass over one band of rows, while it is in cache.

use crate::blend::{self, blend, quantise};
use crate::cover::{Call, Cover};
use crate::fill::FillGradient;
use crate::gradient::add_path;
use crate::saturate::{Overlap, overlap, resolve};
use crate::scene::{Frame, Objective};
use crate::seam::Seam;
use crate::shade::Rgb;
use crate::transpose;
use crate::unblend::{self, removal, unblend};
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

/// Buffers of a worker, reused from band to band; `S` sub-rows a pixel.
#[derive(Debug, Default)]
pub struct Band<const S: usize> {
    cover: Cover<S>,
    /// The colour below every tile, column by column.
    below: Vec<Rgb>,
    picture: Vec<Rgb>,
    grad: Vec<Rgb>,
    curvature: Vec<Lane>,
    seams: Vec<Seam>,
}

impl<const S: usize> Band<S> {
    /// Composites the band at row `top` into `rows [≤ ROWS, width, 3]`.
    pub fn rasterize(&mut self, call: &Call<'_>, top: usize, rows: &mut [f32]) {
        self.begin(call, top);
        for i in 0..self.cover.tiles.len() {
            self.blend_tile(call, i);
        }
        self.write(call.frame, rows);
    }

    /// As `rasterize` if `rows` are given, and carries the objective's gradient back to every path of the band.
    pub fn differentiate(
        &mut self,
        call: &Call<'_>,
        objective: &Objective<'_>,
        importance: bool,
        top: usize,
        rows: Option<&mut [f32]>,
    ) -> BandGradient {
        self.begin(call, top);
        let losses = self.observe(call, objective);
        if let Some(rows) = rows {
            self.write(call.frame, rows);
        }
        let mut gradient = BandGradient { losses, ..BandGradient::default() };
        self.unblend_tiles(call, importance, &mut gradient);
        self.differentiate_outlines(call, &mut gradient);
        gradient
    }

    /// How every path of the band lies over itself, path by path.
    pub fn overlaps(&mut self, call: &Call<'_>, top: usize) -> Vec<(usize, Overlap)> {
        self.cover.fill(call, top);
        let height = ROWS.min(call.frame.height - top);
        let mut found = Vec::new();
        for i in 0..self.cover.tiles.len() {
            let (columns, _) = self.cover.columns(i);
            let mut running = [[0.0; ROWS]; S];
            for column in columns.iter_mut() {
                resolve(&mut running, column);
            }
            let measured = overlap(columns, height);
            found.push((self.cover.tiles[i].path, measured));
        }
        found
    }

    fn begin(&mut self, call: &Call<'_>, top: usize) {
        self.cover.fill(call, top);
        if self.below.len() < self.cover.stored() {
            self.below.resize(self.cover.stored(), [[0.0; ROWS]; 3]);
        }
        self.picture.clear();
        self.picture.resize(call.frame.width, call.frame.canvas.map(|v| [v; ROWS]));
        if call.frame.quantise {
            quantise(&mut self.picture);
        }
    }

    fn write(&self, frame: &Frame<'_>, rows: &mut [f32]) {
        transpose::write(self.picture.as_flattened(), 3 * frame.width, rows);
    }

    fn blend_tile(&mut self, call: &Call<'_>, i: usize) {
        let tile = &self.cover.tiles[i];
        let (fill, place) = (tile.fill(call.paths), tile.place(self.cover.top));
        let (across, storage) = (tile.across(), tile.storage.clone());
        let (winding, mask) = self.cover.columns(i);
        let picture = &mut self.picture[across.clone()];
        blend(&fill, place, blend::Columns { winding, mask, picture, below: &mut self.below[storage] });
        if call.frame.quantise {
            quantise(&mut self.picture[across]);
        }
    }

    /// Composites bottom to top, stopping at every checkpoint to measure its loss.
    fn observe(&mut self, call: &Call<'_>, objective: &Objective<'_>) -> Vec<f64> {
        let mut next = 0;
        let mut losses = Vec::new();
        if let Objective::Checkpoints(checkpoints) = objective {
            self.seams.resize_with(checkpoints.len(), Seam::default);
            for (i, checkpoint) in checkpoints.iter().enumerate() {
                while next < self.cover.tiles.len() && self.cover.tiles[next].path < checkpoint.below {
                    self.blend_tile(call, next);
                    next += 1;
                }
                losses.push(self.seams[i].observe(checkpoint, &self.picture, call.frame, self.cover.top));
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

    /// Goes down the stack: turns windings into their gradients and takes the gradients of fills.
    fn unblend_tiles(&mut self, call: &Call<'_>, importance: bool, out: &mut BandGradient) {
        self.grad.clear();
        self.grad.resize(call.frame.width, [[0.0; ROWS]; 3]);
        self.curvature.clear();
        self.curvature.resize(call.frame.width, [0.0; ROWS]);
        let mut seam = self.seams.len();
        for i in (0..self.cover.tiles.len()).rev() {
            let tile = &self.cover.tiles[i];
            while seam > 0 && self.seams[seam - 1].below > tile.path {
                seam -= 1;
                self.seams[seam].join(&mut self.grad, &mut self.curvature);
            }
            let (fill, place) = (tile.fill(call.paths), tile.place(self.cover.top));
            let (path, across, storage) = (tile.path, tile.across(), tile.storage.clone());
            let (winding, mask) = self.cover.columns(i);
            let grad = &mut self.grad[across.clone()];
            let columns = unblend::Columns { winding, mask, below: &self.below[storage], grad };
            let importance =
                if importance { removal(&fill, place, &columns, &mut self.curvature[across]) } else { 0.0 };
            out.fills.push(FillGradient { importance, ..unblend(&fill, place, columns) });
            out.paths.push(path);
        }
    }

    fn differentiate_outlines(&self, call: &Call<'_>, out: &mut BandGradient) {
        let stride = call.paths.segments * 6;
        out.points.resize(self.cover.tiles.len() * stride, 0.0);
        let tiles = self.cover.tiles.iter().rev();
        for (tile, grad_points) in tiles.zip(out.points.chunks_exact_mut(stride)) {
            add_path(call.chords, &self.cover.boundary(tile), grad_points);
        }
    }
}
