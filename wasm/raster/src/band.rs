//! Forward and backward pass over one band of rows, while it is in cache.

use crate::blend::{self, Rounding, blend_edges, blend_flat, quantise};
use crate::cover::{Call, Cover, Span, Tile};
use crate::fill::{Fill, FillGradient};
use crate::gradient::add_tile;
use crate::lane::{Lane, ROWS, Rgb, ZERO, refill, reserve};
use crate::saturate::{Overlap, coverage, overlap, resolve};
use crate::scene::{Frame, Objective};
use crate::seam::{Seam, join_curvature};
use crate::shade::{Shade, Totals, with_shade};
use crate::transpose;
use crate::unblend::{self, remove_column, unblend_edges, unblend_flat};

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
    /// The colour below every tile, span by span, column by column.
    below: Vec<Rgb>,
    picture: Vec<Rgb>,
    grad: Vec<Rgb>,
    curvature: Vec<Lane>,
    seams: Vec<Seam>,
}

impl<const S: usize> Band<S> {
    /// Composites the band at row `top`; at each of the `heights` of the stack into its rows `[≤ ROWS, width, 3]` of `images`.
    pub fn rasterize(&mut self, call: &Call<'_>, top: usize, heights: &[usize], images: Vec<&mut [f32]>) {
        self.begin(call, top);
        let mut next = 0;
        for (height, rows) in heights.iter().zip(images) {
            next = self.blend_below(call, *height, next);
            self.write(call.frame, rows);
        }
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
        self.unblend_tiles(call, objective, importance, &mut gradient);
        self.differentiate_outlines(call, &mut gradient);
        gradient
    }

    /// How every path of the band lies over itself, path by path.
    pub fn overlaps(&mut self, call: &Call<'_>, top: usize) -> Vec<(usize, Overlap)> {
        self.cover.fill(call, top);
        let mut found = Vec::new();
        let mut columns = Vec::new();
        for tile in &self.cover.tiles {
            let mut running = [ZERO; S];
            columns.clear();
            for span in &self.cover.spans[tile.spans.clone()] {
                for winding in &mut self.cover.winding[span.cells.clone()][..span.edges.len()] {
                    resolve(&mut running, winding);
                    columns.push((1, *winding));
                }
                columns.push((span.flat.len(), running));
            }
            found.push((tile.path, overlap(&columns, call.frame.height - top)));
        }
        found
    }

    fn begin(&mut self, call: &Call<'_>, top: usize) {
        self.cover.fill(call, top);
        reserve(&mut self.below, self.cover.stored, [ZERO; 3]);
        refill(&mut self.picture, call.frame.width, call.frame.canvas.map(Lane::splat));
        if call.frame.quantise {
            quantise(&mut self.picture);
        }
    }

    fn write(&self, frame: &Frame<'_>, rows: &mut [f32]) {
        transpose::write(self.picture.as_flattened(), 3 * frame.width, rows);
    }

    /// Blends tiles from number `next` on as long as their paths are below a height; returns the number of the one after them.
    fn blend_below(&mut self, call: &Call<'_>, height: usize, mut next: usize) -> usize {
        while next < self.cover.tiles.len() && self.cover.tiles[next].path < height {
            self.blend_tile(call, next);
            next += 1;
        }
        next
    }

    /// Blends a tile span by span; flat columns without coverage drop out of the band.
    fn blend_tile(&mut self, call: &Call<'_>, i: usize) {
        let tile = self.cover.tiles[i].clone();
        let (fill, top) = (&tile.fill(call.paths), self.cover.window.top);
        let rounding = match (call.frame.quantise, &fill.axis) {
            (false, _) => Rounding::None,
            (true, None) => Rounding::Solid,
            (true, Some(_)) => Rounding::Gradient,
        };
        let mut running = [ZERO; S];
        for index in tile.spans.clone() {
            let Span { edges, flat, cells, storage } = self.cover.spans[index].clone();
            let mask = tile.mask.map(|start| &self.cover.masks[start..start + edges.len()]);
            let winding = &mut self.cover.winding[cells][..edges.len()];
            let (below, rest) = self.below[storage..].split_at_mut(edges.len());
            let canvas = blend::Canvas { picture: &mut self.picture[edges.clone()], below };
            with_shade!((fill, top, &edges), shade => blend_edges(shade, &mut running, winding, mask, canvas, rounding));
            let covered = coverage(&running);
            if covered == ZERO {
                self.cover.spans[index].flat.end = flat.start;
            } else if !flat.is_empty() {
                let canvas = blend::Canvas { picture: &mut self.picture[flat.clone()], below: rest };
                with_shade!((fill, top, &flat), shade => blend_flat(shade, covered, canvas, rounding));
            }
        }
    }

    /// Composites bottom to top, stopping at every checkpoint to measure its loss.
    fn observe(&mut self, call: &Call<'_>, objective: &Objective<'_>) -> Vec<f64> {
        let (mut next, top) = (0, self.cover.window.top);
        let mut losses = Vec::new();
        if let Objective::Checkpoints(checkpoints) = objective {
            self.seams.resize_with(checkpoints.len(), Seam::default);
            for (i, checkpoint) in checkpoints.iter().enumerate() {
                next = self.blend_below(call, checkpoint.below, next);
                let target = checkpoint.target.band(top);
                losses.push(self.seams[i].observe(checkpoint.below, target, &self.picture));
            }
        }
        for i in next..self.cover.tiles.len() {
            self.blend_tile(call, i);
        }
        if let Objective::Upstream(grad_image) = objective {
            self.seams.resize_with(1, Seam::default);
            self.seams[0].receive(grad_image, call.paths.len(), call.frame.width, top);
        }
        losses
    }

    /// Goes down the stack: turns windings into their gradients and takes the gradients of fills.
    fn unblend_tiles(&mut self, call: &Call<'_>, objective: &Objective<'_>, importance: bool, out: &mut BandGradient) {
        refill(&mut self.grad, call.frame.width, [ZERO; 3]);
        refill(&mut self.curvature, call.frame.width, ZERO);
        let (mut seam, top) = (self.seams.len(), self.cover.window.top);
        for i in (0..self.cover.tiles.len()).rev() {
            let tile = self.cover.tiles[i].clone();
            while seam > 0 && self.seams[seam - 1].below > tile.path {
                seam -= 1;
                self.seams[seam].join(&mut self.grad);
                if let (true, Objective::Checkpoints(checkpoints)) = (importance, objective) {
                    join_curvature(checkpoints[seam].target.band(top), &mut self.curvature);
                }
            }
            let fill = tile.fill(call.paths);
            let importance = if importance { self.remove_tile(&tile, &fill) } else { 0.0 };
            out.fills.push(FillGradient { importance, ..self.unblend_tile(&tile, &fill) });
            out.paths.push(tile.path);
        }
    }

    fn unblend_tile(&mut self, tile: &Tile, fill: &Fill) -> FillGradient {
        let top = self.cover.window.top;
        let mut totals = Totals::ZERO;
        for Span { edges, flat, cells, storage } in self.cover.spans[tile.spans.clone()].iter().cloned() {
            let mask = tile.mask.map(|start| &self.cover.masks[start..start + edges.len()]);
            let winding = &mut self.cover.winding[cells][..edges.len()];
            let covered = winding.last().map_or(ZERO, coverage);
            let (below, rest) = self.below[storage..].split_at(edges.len());
            let canvas = unblend::Canvas { below, grad: &mut self.grad[edges.clone()] };
            with_shade!((fill, top, &edges), shade => unblend_edges(shade, winding, mask, canvas, &mut totals));
            if !flat.is_empty() {
                let canvas = unblend::Canvas { below: rest, grad: &mut self.grad[flat.clone()] };
                with_shade!((fill, top, &flat), shade => unblend_flat(shade, covered, canvas, &mut totals));
            }
        }
        let axis = fill.axis.as_ref().map_or([0.0; 4], |axis| axis.gradient(&totals.moments, top));
        FillGradient { stops: totals.stops.map(|stop| stop.map(Lane::reduce_add)), axis, importance: 0.0 }
    }

    /// Exact loss increase if the tile were removed; to be asked before it is unblended.
    fn remove_tile(&mut self, tile: &Tile, fill: &Fill) -> f64 {
        let mut increase = [0.0_f64; ROWS];
        for span in &self.cover.spans[tile.spans.clone()] {
            let mask = tile.mask.map(|start| &self.cover.masks[start..]);
            let winding = &self.cover.winding[span.cells.clone()];
            let columns = span.edges.start..span.flat.end;
            with_shade!((fill, self.cover.window.top, &columns), start => {
                let mut shade = start;
                for (i, column) in columns.enumerate() {
                    let covered = coverage(&winding[i.min(span.edges.len() - 1)]);
                    let visible = mask.map_or(covered, |mask| covered * mask[i]);
                    let (below, q) = (&self.below[span.storage + i], &mut self.curvature[column]);
                    let rows = remove_column(&shade, visible, below, &self.grad[column], q);
                    for (sum, row) in increase.iter_mut().zip(rows.to_array()) {
                        *sum += f64::from(row);
                    }
                    shade.advance();
                }
            });
        }
        increase.into_iter().sum()
    }

    fn differentiate_outlines(&self, call: &Call<'_>, out: &mut BandGradient) {
        let stride = call.paths.segments * 6;
        out.points.resize(self.cover.tiles.len() * stride, 0.0);
        let tiles = self.cover.tiles.iter().rev();
        for (tile, grad_points) in tiles.zip(out.points.chunks_exact_mut(stride)) {
            if let Some(part) = call.outlines.part_of(tile.path) {
                add_tile(&part.chords, &self.cover, tile, grad_points);
            }
        }
    }
}
