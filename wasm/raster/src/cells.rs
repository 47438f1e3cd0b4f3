//! Clips a path's chords to a band and walks them pixel by pixel, adding exact signed areas.
//!
//! A band is [`ROWS`] pixel rows of the frame. Inside it everything is stored by column: a *lane* holds the `ROWS` pixels of
//! one column, so that running sums along x and all blending are plain vector operations without tails.

use crate::flatten::Chords;

/// Pixel rows of a band: one 512-bit or two 256-bit vectors.
pub const ROWS: usize = 16;

/// One value for each of a column's pixels in a band.
pub type Lane = [f32; ROWS];

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
    x: f32,
    y: f32,
    dx: f32,
    dy: f32,
}

/// A passage of a piece through one cell, ending at parameter `end` of the piece; it starts where the one before ended.
#[derive(Debug, Clone, Copy)]
pub struct Passage {
    /// Index of the cell among the winding cells of the band.
    pub cell: u32,
    pub end: f32,
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
pub fn clip_path(
    chords: &Chords,
    path: usize,
    window: Window,
    pieces: &mut Vec<Piece>,
) -> Option<Columns> {
    let before = pieces.len();
    let (top, bottom) = (window.top as f32, (window.top + ROWS) as f32);
    let mut clip = Clip {
        window,
        pieces,
        low: f32::MAX,
        high: f32::MIN,
        beyond: false,
    };
    for segment in path * chords.segments..(path + 1) * chords.segments {
        let (low, high) = chords.rows[segment];
        if high < top || low >= bottom {
            continue;
        }
        let start = chords.start[segment];
        for vertex in start..start + chords.count[segment] {
            let v = vertex as usize;
            clip.chord(
                vertex,
                segment as u32,
                [chords.x[v], chords.y[v]],
                [chords.x[v + 1], chords.y[v + 1]],
            );
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
        let last = if self.beyond {
            width
        } else {
            (self.high.ceil() as usize).min(width)
        };
        (self.beyond || self.high > 0.0).then_some(Columns {
            first,
            last: last.max(first + 1),
        })
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
        self.sides(Piece {
            vertex,
            segment,
            t0: ta,
            share: tb - ta,
            x: xa,
            y: ya,
            dx: xb - xa,
            dy: yb - ya,
        });
    }

    /// Splits a part at the canvas' left and right borders; clamping x instead would bend it.
    fn sides(&mut self, p: Piece) {
        let width = self.window.width as f32;
        let (low, high) = (p.x.min(p.x + p.dx), p.x.max(p.x + p.dx));
        if low >= 0.0 && high <= width {
            return self.push(p);
        }
        let at = |x: f32| {
            if p.dx == 0.0 {
                0.0
            } else {
                ((x - p.x) / p.dx).clamp(0.0, 1.0)
            }
        };
        let (enter, leave) = if p.dx >= 0.0 {
            (at(0.0), at(width))
        } else {
            (at(width), at(0.0))
        };
        for (u0, u1) in [(0.0, enter), (enter, leave), (leave, 1.0)] {
            if u1 > u0 {
                self.side(p, u0, u1);
            }
        }
        if p.dx == 0.0 {
            self.side(p, 0.0, 1.0);
        }
    }

    /// Keeps one of the three parts: as it is inside, projected onto the border left of it, dropped right of it.
    fn side(&mut self, p: Piece, u0: f32, u1: f32) {
        let width = self.window.width as f32;
        let middle = p.x + 0.5 * (u0 + u1) * p.dx;
        let y = p.y + u0 * p.dy;
        let part = Piece {
            t0: p.t0 + u0 * p.share,
            y,
            dy: (p.y + u1 * p.dy) - y,
            ..p
        };
        if middle > width {
            self.beyond = true;
        } else if middle < 0.0 {
            self.push(Piece {
                share: 0.0,
                x: 0.0,
                dx: 0.0,
                ..part
            });
        } else {
            let x = (p.x + u0 * p.dx).clamp(0.0, width);
            let dx = (p.x + u1 * p.dx).clamp(0.0, width) - x;
            self.push(Piece {
                share: (u1 - u0) * p.share,
                x,
                dx,
                ..part
            });
        }
    }

    fn push(&mut self, p: Piece) {
        self.low = self.low.min(p.x.min(p.x + p.dx));
        self.high = self.high.max(p.x.max(p.x + p.dx));
        self.pieces.push(p);
    }
}

/// Winding cells of one tile: `(columns + 1) · subrows` lanes, starting at cell `base` of the band.
#[derive(Debug)]
pub struct Grid<'a> {
    /// Signed area differences along x; their running sum is the average winding.
    pub cells: &'a mut [f32],
    pub base: u32,
    pub columns: Columns,
    pub subrows: usize,
}

impl Grid<'_> {
    /// Cell of a column (counted from the tile's first) and a sub-row.
    fn index(&self, column: usize, subrow: usize) -> usize {
        (column * self.subrows + subrow % self.subrows) * ROWS + subrow / self.subrows
    }

    /// Walks a piece through the cells that it crosses, adds its areas and notes its passages.
    ///
    /// A passage spanning `d` rows at mean distance `m` from its cell's left side covers `d·(1 − m)` of the cell and all `d`
    /// of the cells to the right of it, hence `d·m` more from the next cell on.
    pub fn walk(&mut self, p: &Piece, passages: &mut Vec<Passage>) {
        let (right, bottom) = (
            (self.columns.last - self.columns.first) as i32 - 1,
            (ROWS * self.subrows) as i32 - 1,
        );
        let x = p.x - self.columns.first as f32;
        let mut across = Axis::new(x, p.dx);
        let mut down = Axis::new(p.y, p.dy);
        let next_column = ROWS * self.subrows;
        let mut start = 0.0_f32;
        loop {
            let end = across.next.min(down.next).min(1.0).max(start);
            let column = across.cell.clamp(0, right) as usize;
            let cell = self.index(column, down.cell.clamp(0, bottom) as usize);
            let d = (end - start) * p.dy;
            let m = (x + 0.5 * (start + end) * p.dx - column as f32).clamp(0.0, 1.0);
            self.cells[cell] += d - d * m;
            self.cells[cell + next_column] += d * m;
            passages.push(Passage {
                cell: self.base + cell as u32,
                end,
            });
            if end >= 1.0 {
                return;
            }
            start = end;
            if across.next <= down.next {
                across.advance()
            } else {
                down.advance()
            }
        }
    }
}

/// Grid lines of one axis that a piece crosses, one after the other.
struct Axis {
    cell: i32,
    step: i32,
    /// Parameter of the next crossing.
    next: f32,
    origin: f32,
    inverse: f32,
}

/// A piece advancing less than this along an axis crosses at most one grid line there, at its very end.
const STANDSTILL: f32 = 1e-6;

impl Axis {
    fn new(origin: f32, delta: f32) -> Self {
        if delta.abs() < STANDSTILL {
            return Self {
                cell: origin.floor() as i32,
                step: 0,
                next: f32::INFINITY,
                origin,
                inverse: 0.0,
            };
        }
        let (cell, step) = if delta > 0.0 {
            (origin.floor() as i32, 1)
        } else {
            (origin.ceil() as i32 - 1, -1)
        };
        let mut axis = Self {
            cell: cell - step,
            step,
            next: 0.0,
            origin,
            inverse: 1.0 / delta,
        };
        axis.advance();
        axis
    }

    fn advance(&mut self) {
        self.cell += self.step;
        let line = self.cell + i32::from(self.step > 0);
        self.next = (line as f32 - self.origin) * self.inverse;
    }
}
