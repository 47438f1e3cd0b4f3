//! Turns the outlines that touch a band into tiles of winding.

use crate::clip::{Columns, Piece, Window, clip_path};
use crate::fill::Fill;
use crate::flatten::Chords;
use crate::gradient::Boundary;
use crate::scene::{Frame, Paths};
use crate::shade::Place;
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
    columns: Columns,
    pieces: Range<usize>,
    /// Columns of the winding buffer, one more than the tile has.
    winding: Range<usize>,
    /// Columns of buffers that have no spare one.
    pub storage: Range<usize>,
    /// Columns of the mask buffer, if the path is clipped.
    mask: Option<Range<usize>>,
}

impl Tile {
    /// Columns of the frame.
    pub fn across(&self) -> Range<usize> {
        self.columns.first..self.columns.last
    }

    pub fn place(&self, top: usize) -> Place {
        Place { top, column: self.columns.first }
    }

    pub fn fill(&self, paths: &Paths<'_>) -> Fill {
        Fill::new(self.path, paths.stops, paths.axis, paths.gradient[self.path])
    }
}

/// Tiles of a band in painter's order, with the buffers that they index; `S` sub-rows a pixel.
#[derive(Debug)]
pub struct Cover<const S: usize> {
    pub top: usize,
    pub tiles: Vec<Tile>,
    pieces: Vec<Piece>,
    passages: Vec<Passage>,
    /// First passage of each piece, and the end of the last one's.
    passage_starts: Vec<usize>,
    winding: Vec<[Lane; S]>,
    masks: Vec<Lane>,
}

impl<const S: usize> Default for Cover<S> {
    fn default() -> Self {
        Self {
            top: 0,
            tiles: Vec::new(),
            pieces: Vec::new(),
            passages: Vec::new(),
            passage_starts: Vec::new(),
            winding: Vec::new(),
            masks: Vec::new(),
        }
    }
}

impl<const S: usize> Cover<S> {
    /// Clips and walks all paths of the band at row `top`.
    pub fn fill(&mut self, call: &Call<'_>, top: usize) {
        self.top = top;
        self.place_tiles(call);
        self.walk_tiles();
    }

    /// Columns of storage that all tiles take.
    pub fn stored(&self) -> usize {
        self.tiles.last().map_or(0, |tile| tile.storage.end)
    }

    /// Winding columns of a tile, without the spare one, and its mask.
    pub fn columns(&mut self, tile: usize) -> (&mut [[Lane; S]], Option<&[Lane]>) {
        let tile = &self.tiles[tile];
        let winding = &mut self.winding[tile.winding.start..tile.winding.end - 1];
        (winding, tile.mask.clone().map(|mask| &self.masks[mask]))
    }

    /// A tile's pieces, once its windings are gradients.
    pub fn boundary(&self, tile: &Tile) -> Boundary<'_> {
        Boundary {
            pieces: &self.pieces[tile.pieces.clone()],
            starts: &self.passage_starts[tile.pieces.start..=tile.pieces.end],
            passages: &self.passages,
            grad_winding: self.winding.as_flattened().as_flattened(),
        }
    }

    fn place_tiles(&mut self, call: &Call<'_>) {
        self.tiles.clear();
        self.pieces.clear();
        self.masks.clear();
        let window = Window { top: self.top, width: call.frame.width, subrows: S };
        let (mut wound, mut stored) = (0, 0);
        for path in 0..call.paths.len() {
            let first = self.pieces.len();
            let Some(columns) = clip_path(call.chords, path, window, &mut self.pieces) else {
                continue;
            };
            let width = columns.last - columns.first;
            let pieces = first..self.pieces.len();
            let (winding, storage) = (wound..wound + width + 1, stored..stored + width);
            (wound, stored) = (winding.end, storage.end);
            let mask = self.read_mask(call, path, columns);
            self.tiles.push(Tile { path, columns, pieces, winding, storage, mask });
        }
        self.winding.clear();
        self.winding.resize(wound, [[0.0; ROWS]; S]);
    }

    /// Copies a tile's part of its path's clip mask.
    fn read_mask(&mut self, call: &Call<'_>, path: usize, columns: Columns) -> Option<Range<usize>> {
        let (width, pixels) = (call.frame.width, call.frame.width * call.frame.height);
        let mask = usize::try_from(call.paths.clip[path]).ok()?;
        let first = self.masks.len();
        self.masks.resize(first + columns.last - columns.first, [0.0; ROWS]);
        let image = &call.frame.clips[mask * pixels..][..pixels];
        transpose::read(image, width, self.top, columns.first, &mut self.masks[first..]);
        Some(first..self.masks.len())
    }

    fn walk_tiles(&mut self) {
        self.passages.clear();
        self.passage_starts.clear();
        for tile in &self.tiles {
            let mut grid = Grid {
                cells: self.winding[tile.winding.clone()].as_flattened_mut().as_flattened_mut(),
                base: (tile.winding.start * S * ROWS) as u32,
                columns: tile.columns,
                shift: S.trailing_zeros(),
            };
            for piece in &self.pieces[tile.pieces.clone()] {
                self.passage_starts.push(self.passages.len());
                grid.walk(piece, &mut self.passages);
            }
        }
        self.passage_starts.push(self.passages.len());
    }
}
