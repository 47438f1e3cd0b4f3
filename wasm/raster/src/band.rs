//! Forward and backward pass over one band of rows, while it is in cache.

use crate::cells::{Columns, Grid, Lane, Passage, Piece, ROWS, Window, clip_path};
use crate::composite::{Place, Rgb, Upstream, blend, quantise, unblend};
use crate::fill::{Fill, FillGradient};
use crate::flatten::Chords;
use crate::gradient::{Field, add_piece};
use crate::resolve::{Overlap, overlap, resolve};
use crate::scene::{Frame, Objective, Paths};
use crate::seam::{Seam, read_grey, write_rgb};
use std::ops::Range;

/// Everything that the bands of a call share.
#[derive(Debug)]
pub struct Call<'a> {
    pub paths: &'a Paths<'a>,
    pub frame: &'a Frame<'a>,
    pub chords: &'a Chords,
}

/// The part of a path inside the band.
#[derive(Debug)]
struct Tile {
    path: usize,
    columns: Columns,
    pieces: Range<usize>,
    /// Lanes of the winding buffer.
    winding: Range<usize>,
    /// Columns of the coverage and below buffers.
    storage: Range<usize>,
}

/// Gradients of the paths of one band; tile by tile in painter's order.
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
    top: usize,
    tiles: Vec<Tile>,
    pieces: Vec<Piece>,
    passages: Vec<Passage>,
    /// First passage of each piece, and the end of the last one's.
    passage_starts: Vec<usize>,
    winding: Vec<Lane>,
    coverage: Vec<Lane>,
    below: Vec<Rgb>,
    picture: Vec<Rgb>,
    grad: Vec<Rgb>,
    curvature: Vec<Lane>,
    seams: Vec<Seam>,
}

impl Band {
    /// Composites the band that starts at row `top` into `rows [≤ ROWS, width, 3]`.
    pub fn rasterize(&mut self, call: &Call<'_>, top: usize, rows: &mut [f32]) {
        self.cover(call, top);
        self.clear_picture(call.frame);
        for i in 0..self.tiles.len() {
            self.blend_tile(call, i);
        }
        write_rgb(&self.picture, rows);
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
        self.cover(call, top);
        self.clear_picture(call.frame);
        let losses = self.observe(call, objective);
        write_rgb(&self.picture, rows);
        let mut gradient = BandGradient {
            losses,
            ..BandGradient::default()
        };
        self.backward(call, importance, &mut gradient);
        gradient
    }

    /// Coverage of path `path` alone, transposed into `rows [≤ ROWS, width]`.
    pub fn coverage(&mut self, call: &Call<'_>, top: usize, rows: &mut [f32]) {
        self.cover(call, top);
        for tile in &self.tiles {
            for (column, lane) in (tile.columns.first..).zip(&self.coverage[tile.storage.clone()]) {
                for (line, value) in rows.chunks_exact_mut(call.frame.width).zip(lane) {
                    line[column] = *value;
                }
            }
        }
    }

    /// How often every path of the band lies over itself, path by path.
    pub fn overlaps(&mut self, call: &Call<'_>, top: usize) -> Vec<(usize, Overlap)> {
        self.cover(call, top);
        let height = ROWS.min(call.frame.height - top);
        let of = |tile: &Tile| {
            overlap(
                &self.winding[tile.winding.clone()],
                call.frame.subrows,
                tile.storage.len(),
                height,
            )
        };
        self.tiles
            .iter()
            .map(|tile| (tile.path, of(tile)))
            .collect()
    }

    /// Clips, walks and resolves all paths: tiles, windings and coverage of the band.
    fn cover(&mut self, call: &Call<'_>, top: usize) {
        self.top = top;
        self.place_tiles(call);
        self.passages.clear();
        self.passage_starts.clear();
        let subrows = call.frame.subrows;
        for tile in &self.tiles {
            let cells = self.winding[tile.winding.clone()].as_flattened_mut();
            let base = (tile.winding.start * ROWS) as u32;
            let mut grid = Grid {
                cells,
                base,
                columns: tile.columns,
                subrows,
            };
            for piece in &self.pieces[tile.pieces.clone()] {
                self.passage_starts.push(self.passages.len());
                grid.walk(piece, &mut self.passages);
            }
            let winding = &mut self.winding[tile.winding.clone()];
            let coverage = &mut self.coverage[tile.storage.clone()];
            match subrows {
                1 => resolve::<1>(winding, coverage),
                2 => resolve::<2>(winding, coverage),
                _ => resolve::<4>(winding, coverage),
            }
        }
        self.passage_starts.push(self.passages.len());
        self.apply_clips(call);
    }

    fn place_tiles(&mut self, call: &Call<'_>) {
        self.tiles.clear();
        self.pieces.clear();
        let window = Window {
            top: self.top,
            width: call.frame.width,
            subrows: call.frame.subrows,
        };
        let (mut lanes, mut columns_before) = (0, 0);
        for path in 0..call.paths.len() {
            let first = self.pieces.len();
            let Some(columns) = clip_path(call.chords, path, window, &mut self.pieces) else {
                continue;
            };
            let width = columns.last - columns.first;
            let storage = columns_before..columns_before + width;
            let winding = lanes..lanes + (width + 1) * window.subrows;
            (lanes, columns_before) = (winding.end, storage.end);
            self.tiles.push(Tile {
                path,
                columns,
                pieces: first..self.pieces.len(),
                winding,
                storage,
            });
        }
        self.winding.clear();
        self.winding.resize(lanes, [0.0; ROWS]);
        self.coverage.resize(columns_before, [0.0; ROWS]);
        self.below.resize(columns_before, [[0.0; ROWS]; 3]);
    }

    /// Multiplies clipped tiles' coverage, or its gradient, by their masks.
    fn apply_clips(&mut self, call: &Call<'_>) {
        for tile in &self.tiles {
            clip_tile(
                call,
                tile,
                self.top,
                &mut self.coverage[tile.storage.clone()],
            );
        }
    }

    fn clear_picture(&mut self, frame: &Frame<'_>) {
        self.picture.clear();
        self.picture
            .resize(frame.width, frame.canvas.map(|v| [v; ROWS]));
        if frame.quantise {
            quantise(&mut self.picture);
        }
    }

    fn blend_tile(&mut self, call: &Call<'_>, i: usize) {
        let tile = &self.tiles[i];
        let place = Place {
            top: self.top,
            column: tile.columns.first,
        };
        let picture = &mut self.picture[tile.columns.first..tile.columns.last];
        blend(
            &fill(call, tile),
            place,
            &self.coverage[tile.storage.clone()],
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
            for (seam, checkpoint) in checkpoints.iter().enumerate() {
                while next < self.tiles.len() && self.tiles[next].path < checkpoint.below {
                    self.blend_tile(call, next);
                    next += 1;
                }
                losses.push(self.seams[seam].observe(
                    checkpoint,
                    &self.picture,
                    call.frame,
                    self.top,
                ));
            }
        }
        for i in next..self.tiles.len() {
            self.blend_tile(call, i);
        }
        if let Objective::Upstream(grad_image) = objective {
            self.seams.resize_with(1, Seam::default);
            self.seams[0].receive(grad_image, call.paths.len(), call.frame, self.top);
        }
        losses
    }

    /// Goes down the stack: gradients of coverage, fills and points, tile by tile.
    fn backward(&mut self, call: &Call<'_>, importance: bool, out: &mut BandGradient) {
        let width = call.frame.width;
        self.grad.clear();
        self.grad.resize(width, [[0.0; ROWS]; 3]);
        self.curvature.clear();
        self.curvature.resize(width, [0.0; ROWS]);
        let mut seam = self.seams.len();
        for tile in self.tiles.iter().rev() {
            while seam > 0 && self.seams[seam - 1].below > tile.path {
                seam -= 1;
                join(&self.seams[seam], &mut self.grad, &mut self.curvature);
            }
            let across = tile.columns.first..tile.columns.last;
            let coverage = &mut self.coverage[tile.storage.clone()];
            let place = Place {
                top: self.top,
                column: tile.columns.first,
            };
            let curvature = importance.then_some(&mut self.curvature[across.clone()]);
            let upstream = Upstream {
                grad: &mut self.grad[across],
                curvature,
            };
            out.fills.push(unblend(
                &fill(call, tile),
                place,
                coverage,
                &self.below[tile.storage.clone()],
                upstream,
            ));
            out.paths.push(tile.path);
            clip_tile(call, tile, self.top, coverage);
        }
        let stride = call.paths.segments * 6;
        out.points.resize(self.tiles.len() * stride, 0.0);
        for (tile, grad_points) in self
            .tiles
            .iter()
            .rev()
            .zip(out.points.chunks_exact_mut(stride))
        {
            let field = Field {
                winding: self.winding.as_flattened(),
                grad_coverage: &self.coverage[tile.storage.clone()],
                base: tile.winding.start * ROWS,
                subrows: call.frame.subrows,
            };
            for i in tile.pieces.clone() {
                let passages = &self.passages[self.passage_starts[i]..self.passage_starts[i + 1]];
                add_piece(call.chords, &field, &self.pieces[i], passages, grad_points);
            }
        }
    }
}

fn fill(call: &Call<'_>, tile: &Tile) -> Fill {
    Fill::new(
        tile.path,
        call.paths.stops,
        call.paths.axis,
        call.paths.gradient[tile.path],
    )
}

fn clip_tile(call: &Call<'_>, tile: &Tile, top: usize, lanes: &mut [Lane]) {
    let pixels = call.frame.width * call.frame.height;
    let Ok(mask) = usize::try_from(call.paths.clip[tile.path]) else {
        return;
    };
    let mask = &call.frame.clips[mask * pixels..(mask + 1) * pixels];
    let mut columns = vec![[0.0; ROWS]; call.frame.width];
    read_grey(mask, call.frame, top, &mut columns);
    for (lane, clip) in lanes.iter_mut().zip(&columns[tile.columns.first..]) {
        for l in 0..ROWS {
            lane[l] *= clip[l];
        }
    }
}

fn join(seam: &Seam, grad: &mut [Rgb], curvature: &mut [Lane]) {
    for (g, joining) in grad
        .as_flattened_mut()
        .iter_mut()
        .zip(seam.grad.as_flattened())
    {
        for l in 0..ROWS {
            g[l] += joining[l];
        }
    }
    for (q, joining) in curvature.iter_mut().zip(&seam.curvature) {
        for l in 0..ROWS {
            q[l] += joining[l];
        }
    }
}
