//! Turns the outlines that touch a band into tiles of coverage.

use crate::clip::{Columns, Piece, Window, clip_path};
use crate::composite::Place;
use crate::fill::Fill;
use crate::flatten::Chords;
use crate::gradient::Boundary;
use crate::resolve::{self, Overlap, resolve};
use crate::scene::{Frame, Paths};
use crate::transpose;
use crate::walk::{Grid, Lane, Passage, ROWS};
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
pub struct Tile {
    pub path: usize,
    pub columns: Columns,
    pub pieces: Range<usize>,
    /// Lanes of the winding buffer: `(columns + 1) · subrows`.
    winding: Range<usize>,
    /// Lanes of the coverage buffer, one a column.
    pub storage: Range<usize>,
}

/// Tiles of a band in painter's order, with the buffers that they index.
#[derive(Debug, Default)]
pub struct Cover {
    pub top: usize,
    pub tiles: Vec<Tile>,
    pub pieces: Vec<Piece>,
    pub passages: Vec<Passage>,
    /// First passage of each piece, and the end of the last one's.
    pub passage_starts: Vec<usize>,
    winding: Vec<Lane>,
    /// Coverage times clip mask; the backward pass turns it into its gradient.
    pub coverage: Vec<Lane>,
}

impl Tile {
    /// Columns of the frame.
    pub fn across(&self) -> Range<usize> {
        self.columns.first..self.columns.last
    }

    pub fn place(&self, top: usize) -> Place {
        Place {
            top,
            column: self.columns.first,
        }
    }

    pub fn fill(&self, paths: &Paths<'_>) -> Fill {
        Fill::new(
            self.path,
            paths.stops,
            paths.axis,
            paths.gradient[self.path],
        )
    }
}

impl Cover {
    /// Clips, walks and resolves all paths of the band at row `top`.
    pub fn fill(&mut self, call: &Call<'_>, top: usize) {
        self.top = top;
        self.place_tiles(call);
        self.walk_tiles(call.frame.subrows);
        for tile in &self.tiles {
            let winding = &mut self.winding[tile.winding.clone()];
            let coverage = &mut self.coverage[tile.storage.clone()];
            match call.frame.subrows {
                1 => resolve::<1>(winding, coverage),
                2 => resolve::<2>(winding, coverage),
                _ => resolve::<4>(winding, coverage),
            }
        }
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
        let (mut lanes, mut stored) = (0, 0);
        for path in 0..call.paths.len() {
            let first = self.pieces.len();
            let Some(columns) = clip_path(call.chords, path, window, &mut self.pieces) else {
                continue;
            };
            let width = columns.last - columns.first;
            let storage = stored..stored + width;
            let winding = lanes..lanes + (width + 1) * window.subrows;
            (lanes, stored) = (winding.end, storage.end);
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
        self.coverage.resize(stored, [0.0; ROWS]);
    }

    fn walk_tiles(&mut self, subrows: usize) {
        self.passages.clear();
        self.passage_starts.clear();
        for tile in &self.tiles {
            let cells = self.winding[tile.winding.clone()].as_flattened_mut();
            let base = (tile.winding.start * ROWS) as u32;
            let mut grid = Grid {
                cells,
                base,
                columns: tile.columns,
                shift: subrows.trailing_zeros(),
            };
            for piece in &self.pieces[tile.pieces.clone()] {
                self.passage_starts.push(self.passages.len());
                grid.walk(piece, &mut self.passages);
            }
        }
        self.passage_starts.push(self.passages.len());
    }

    /// Multiplies clipped tiles' coverage, or its gradient, by their masks.
    pub fn apply_clips(&mut self, call: &Call<'_>) {
        let (width, pixels) = (call.frame.width, call.frame.width * call.frame.height);
        let mut columns = Vec::new();
        for tile in &self.tiles {
            let Ok(mask) = usize::try_from(call.paths.clip[tile.path]) else {
                continue;
            };
            columns.resize(width, [0.0; ROWS]);
            transpose::read(
                &call.frame.clips[mask * pixels..(mask + 1) * pixels],
                width,
                self.top,
                &mut columns,
            );
            for (lane, clip) in self.coverage[tile.storage.clone()]
                .iter_mut()
                .zip(&columns[tile.columns.first..])
            {
                for l in 0..ROWS {
                    lane[l] *= clip[l];
                }
            }
        }
    }

    /// Turns windings into gradients by them, once `coverage` holds gradients.
    pub fn grad_winding(&mut self, subrows: usize) {
        for tile in &self.tiles {
            let winding = &mut self.winding[tile.winding.clone()];
            let grad = &self.coverage[tile.storage.clone()];
            match subrows {
                1 => resolve::grad_winding::<1>(winding, grad),
                2 => resolve::grad_winding::<2>(winding, grad),
                _ => resolve::grad_winding::<4>(winding, grad),
            }
        }
    }

    /// A tile's pieces, once `grad_winding` has run.
    pub fn boundary(&self, tile: &Tile) -> Boundary<'_> {
        Boundary {
            pieces: &self.pieces[tile.pieces.clone()],
            starts: &self.passage_starts[tile.pieces.start..=tile.pieces.end],
            passages: &self.passages,
            grad_winding: self.winding.as_flattened(),
        }
    }

    /// How often every path of the band lies over itself, path by path.
    pub fn overlaps(&self, frame: &Frame<'_>) -> Vec<(usize, Overlap)> {
        let height = ROWS.min(frame.height - self.top);
        let of = |tile: &Tile| {
            resolve::overlap(
                &self.winding[tile.winding.clone()],
                frame.subrows,
                tile.storage.len(),
                height,
            )
        };
        self.tiles
            .iter()
            .map(|tile| (tile.path, of(tile)))
            .collect()
    }
}
