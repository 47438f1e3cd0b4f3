//! Cuts a path's chords at the borders of a band and of the canvas.

use crate::flatten::Chords;
use crate::walk::ROWS;

/// The part of a chord inside the band and the canvas; x in pixels, y in sub-rows below the band's top.
#[derive(Debug, Clone, Copy)]
pub struct Piece {
    /// First vertex of the whole chord.
    pub vertex: u32,
    /// Global index of the segment.
    pub segment: u32,
    /// The whole chord's parameter where this part starts, and the share of the chord that it covers.
    /// Parts projected onto the left border have no share: they wind, but no pixel sees them move.
    pub t0: f32,
    pub share: f32,
    pub x: f32,
    pub y: f32,
    pub dx: f32,
    pub dy: f32,
}

/// Vertical extent of a band in sub-rows, and the frame's width.
#[derive(Debug, Clone, Copy)]
pub struct Window {
    /// First pixel row.
    pub top: usize,
    pub width: usize,
    pub subrows: usize,
}

/// Columns that a path may cover in a band, `first..last`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Columns {
    pub first: usize,
    pub last: usize,
}

/// Appends the parts of a path's chords inside the window and returns the columns that they wind around, if any.
pub fn clip_path(chords: &Chords, path: usize, window: Window, pieces: &mut Vec<Piece>) -> Option<Columns> {
    let before = pieces.len();
    let (top, bottom) = (window.top as f32, (window.top + ROWS) as f32);
    let (low, high) = chords.path_rows[path];
    if high < top || low >= bottom {
        return None;
    }
    let mut clip = Clip { window, pieces, low: f32::MAX, high: f32::MIN, beyond: false };
    for segment in path * chords.segments..(path + 1) * chords.segments {
        let (low, high) = chords.segment_rows[segment];
        if high < top || low >= bottom {
            continue;
        }
        let start = chords.start[segment];
        for vertex in start..start + chords.count[segment] {
            let v = vertex as usize;
            clip.chord(vertex, segment as u32, [chords.x[v], chords.y[v]], [chords.x[v + 1], chords.y[v + 1]]);
        }
    }
    let columns = clip.columns();
    if columns.is_none() {
        pieces.truncate(before);
    }
    columns
}

struct Clip<'a> {
    window: Window,
    pieces: &'a mut Vec<Piece>,
    low: f32,
    high: f32,
    /// Some part lies right of the canvas: the winding reaches its right border.
    beyond: bool,
}

impl Clip<'_> {
    fn columns(&self) -> Option<Columns> {
        let width = self.window.width;
        if self.low > self.high {
            return None;
        }
        let first = (self.low as usize).min(width - 1);
        let last = if self.beyond { width } else { (self.high.ceil() as usize).min(width) };
        (self.beyond || self.high > 0.0).then_some(Columns { first, last: last.max(first + 1) })
    }

    /// Cuts a chord at the band's top and bottom.
    fn chord(&mut self, vertex: u32, segment: u32, p0: [f32; 2], p1: [f32; 2]) {
        let (scale, top) = (self.window.subrows as f32, self.window.top as f32);
        let rows = (ROWS * self.window.subrows) as f32;
        let (y0, y1) = ((p0[1] - top) * scale, (p1[1] - top) * scale);
        let outside = y0.min(y1) >= rows || y0.max(y1) < 0.0 || (y0.max(y1) == 0.0 && y0 != y1);
        let (dx, dy) = (p1[0] - p0[0], y1 - y0);
        if outside || (dx == 0.0 && dy == 0.0) {
            return;
        }
        let (ya, yb) = (y0.clamp(0.0, rows), y1.clamp(0.0, rows));
        let ta = if ya == y0 { 0.0 } else { (ya - y0) / dy };
        let tb = if yb == y1 { 1.0 } else { (yb - y0) / dy };
        let xa = if ya == y0 { p0[0] } else { p0[0] + ta * dx };
        let xb = if yb == y1 { p1[0] } else { p0[0] + tb * dx };
        self.sides(Piece { vertex, segment, t0: ta, share: tb - ta, x: xa, y: ya, dx: xb - xa, dy: yb - ya });
    }

    /// Splits a part at the canvas' left and right borders; clamping x instead would bend it.
    fn sides(&mut self, p: Piece) {
        let width = self.window.width as f32;
        let (low, high) = (p.x.min(p.x + p.dx), p.x.max(p.x + p.dx));
        if low >= 0.0 && high <= width {
            return self.push(p);
        }
        if p.dx == 0.0 {
            return self.side(p, 0.0, 1.0);
        }
        let at = |x: f32| ((x - p.x) / p.dx).clamp(0.0, 1.0);
        let (enter, leave) = if p.dx > 0.0 { (at(0.0), at(width)) } else { (at(width), at(0.0)) };
        for (u0, u1) in [(0.0, enter), (enter, leave), (leave, 1.0)] {
            if u1 > u0 {
                self.side(p, u0, u1);
            }
        }
    }

    /// Keeps one of the three parts: as it is inside, projected onto the border left of it, dropped right of it.
    fn side(&mut self, p: Piece, u0: f32, u1: f32) {
        let width = self.window.width as f32;
        let middle = p.x + 0.5 * (u0 + u1) * p.dx;
        let y = p.y + u0 * p.dy;
        let part = Piece { t0: p.t0 + u0 * p.share, y, dy: (p.y + u1 * p.dy) - y, ..p };
        if middle > width {
            self.beyond = true;
        } else if middle < 0.0 {
            self.push(Piece { share: 0.0, x: 0.0, dx: 0.0, ..part });
        } else {
            let x = (p.x + u0 * p.dx).clamp(0.0, width);
            let dx = (p.x + u1 * p.dx).clamp(0.0, width) - x;
            self.push(Piece { share: (u1 - u0) * p.share, x, dx, ..part });
        }
    }

    fn push(&mut self, p: Piece) {
        self.low = self.low.min(p.x.min(p.x + p.dx));
        self.high = self.high.max(p.x.max(p.x + p.dx));
        self.pieces.push(p);
    }
}
