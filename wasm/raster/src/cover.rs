//! Turns the outlines that touch a band into sparse winding: edge columns in memory, what lies between them in spans.

use crate::clip::{Piece, clip};
use crate::fill::Fill;
use crate::lane::{Lane, ZERO, refill};
use crate::line::Window;
use crate::marks::Marks;
use crate::outlines::{Outlines, Part};
use crate::sample::sample;
use crate::scene::{Frame, Paths};
use crate::transpose;
use crate::walk::{integrate, walk};
use std::ops::Range;

/// Everything that the bands of a call share.
#[derive(Debug)]
pub struct Call<'a> {
    pub paths: &'a Paths<'a>,
    pub frame: &'a Frame<'a>,
    pub outlines: Outlines<'a>,
    /// Chords are sampled on a grid instead of integrated.
    pub sampled: bool,
}

impl<'a> Call<'a> {
    pub fn new(paths: &'a Paths<'a>, frame: &'a Frame<'a>, sampled: bool) -> Self {
        Self { paths, frame, outlines: Outlines::new(paths, frame, sampled), sampled }
    }
}

/// Columns whose windings are stored, followed by columns that repeat the last of them.
#[derive(Debug, Clone)]
pub struct Span {
    pub edges: Range<usize>,
    pub flat: Range<usize>,
    /// Winding cells of the edge columns.
    pub cells: Range<usize>,
    /// Where what is stored by painted column begins.
    pub storage: usize,
}

/// The part of a path inside the band.
#[derive(Debug, Clone)]
pub struct Tile {
    pub path: usize,
    pub spans: Range<usize>,
    pieces: Range<usize>,
    /// Start of its columns in the masks, if the path is clipped; it has one span then.
    pub mask: Option<usize>,
}

impl Tile {
    pub fn fill(&self, paths: &Paths<'_>) -> Fill {
        Fill::new(self.path, paths.stops, paths.axis, paths.gradient[self.path])
    }
}

/// Tiles of a band in painter's order, with the buffers that they index; `S` sub-rows a pixel.
#[derive(Debug)]
pub struct Cover<const S: usize> {
    pub window: Window,
    pub tiles: Vec<Tile>,
    pub spans: Vec<Span>,
    /// Differences of winding along x; windings once resolved; gradients by them in the end.
    pub winding: Vec<[Lane; S]>,
    /// Painted columns of all spans.
    pub stored: usize,
    pieces: Vec<Piece>,
    /// Clip masks of clipped tiles, column by column.
    pub masks: Vec<Lane>,
    marks: Marks,
    /// Winding cell of every column of the frame, while a path is placed.
    cells: Vec<u32>,
}

impl<const S: usize> Default for Cover<S> {
    fn default() -> Self {
        Self {
            window: Window { top: 0, width: 0, subrows: S },
            tiles: Vec::new(),
            spans: Vec::new(),
            winding: Vec::new(),
            stored: 0,
            pieces: Vec::new(),
            masks: Vec::new(),
            marks: Marks::default(),
            cells: Vec::new(),
        }
    }
}

impl<const S: usize> Cover<S> {
    /// Clips and walks all paths of the band at row `top`.
    pub fn fill(&mut self, call: &Call<'_>, top: usize) {
        self.window = Window { top, width: call.frame.width, subrows: S };
        self.tiles.clear();
        self.spans.clear();
        self.pieces.clear();
        self.masks.clear();
        self.winding.clear();
        self.stored = 0;
        refill(&mut self.cells, call.frame.width + 1, 0);
        for part in call.outlines.parts() {
            let (mut vertices, mut ring) = (part.bins.band(top), 0);
            while let Some(vertex) = vertices.first() {
                while part.chords.rings[ring + 1] <= *vertex {
                    ring += 1;
                }
                let own = vertices.partition_point(|v| *v < part.chords.rings[ring + 1]);
                self.add_path(call, part, part.first + ring, &vertices[..own]);
                vertices = &vertices[own..];
            }
        }
    }

    /// Calls `add` with every piece of a tile and its `∫G dt` and `∫G·t dt`, once windings are gradients.
    pub fn integrate(&self, tile: &Tile, mut add: impl FnMut(&Piece, [f32; 2])) {
        for piece in &self.pieces[tile.pieces.clone()] {
            add(piece, integrate(piece, &self.winding[piece.cell as usize..]));
        }
    }

    fn add_path(&mut self, call: &Call<'_>, part: &Part, path: usize, vertices: &[u32]) {
        let (first_piece, first_span, first_cell) = (self.pieces.len(), self.spans.len(), self.winding.len());
        self.marks.clear(self.window.width);
        let beyond = clip(&part.chords, vertices, self.window, &mut self.pieces, &mut self.marks);
        if self.pieces.len() == first_piece {
            return;
        }
        let mask = usize::try_from(call.paths.clip[path]).ok();
        if mask.is_some() {
            self.close_gaps(beyond);
        }
        self.add_spans(beyond);
        self.winding.resize(self.spans.last().map_or(first_cell, |span| span.cells.end), [ZERO; S]);
        for piece in &mut self.pieces[first_piece..] {
            piece.cell = self.cells[piece.first as usize];
            let cells = &mut self.winding[piece.cell as usize..];
            if call.sampled { sample(piece, cells) } else { walk(piece, cells) }
        }
        let mask = mask.map(|mask| self.read_mask(call, mask, self.spans[first_span].edges.clone()));
        let (spans, pieces) = (first_span..self.spans.len(), first_piece..self.pieces.len());
        self.tiles.push(Tile { path, spans, pieces, mask });
    }

    /// Lets the marks of a clipped path run on without gaps: its coverage changes from column to column everywhere.
    fn close_gaps(&mut self, beyond: bool) {
        let first = self.marks.runs().next().map_or(0, |(first, _)| first);
        let last = self.marks.runs().last().map_or(0, |(_, end)| end - 1);
        self.marks.insert(first, if beyond { self.window.width } else { last });
    }

    /// Turns marked runs into spans; between the last one and the right border nothing is wound, unless a chord is beyond it.
    fn add_spans(&mut self, beyond: bool) {
        let width = self.window.width;
        let mut runs = self.marks.runs().peekable();
        let mut cell = self.winding.len();
        while let Some((first, end)) = runs.next() {
            let next = runs.peek().map_or(if beyond { width } else { end }, |&(next, _)| next);
            let (edges, flat) = (first..end.min(width), end.min(width)..next.min(width));
            for (column, cell) in (first..end).zip(cell as u32..) {
                self.cells[column] = cell;
            }
            let storage = self.stored;
            self.stored += edges.len() + flat.len();
            self.spans.push(Span { edges, flat, cells: cell..cell + end - first, storage });
            cell += end - first;
        }
    }

    /// Copies a path's clip mask over some columns and returns where it begins.
    fn read_mask(&mut self, call: &Call<'_>, mask: usize, columns: Range<usize>) -> usize {
        let pixels = call.frame.width * call.frame.height;
        let start = self.masks.len();
        self.masks.resize(start + columns.len(), ZERO);
        let image = &call.frame.clips[mask * pixels..][..pixels];
        transpose::read(image, call.frame.width, self.window.top, columns.start, &mut self.masks[start..]);
        start
    }
}
