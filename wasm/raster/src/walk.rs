//! Walks the pieces of a path cell by cell and adds their exact signed areas.
//!
//! A band is [`ROWS`] pixel rows of the frame. Inside it everything is stored by column: a *lane* holds the `ROWS` pixels of
//! one column, so that running sums along x and all blending are plain vector operations without tails. Winding cells have a
//! lane for every sub-row of a column.

use crate::clip::{Columns, Piece};

/// Pixel rows of a band: one 512-bit or two 256-bit vectors.
pub const ROWS: usize = 16;

/// One value for each of a column's pixels in a band.
pub type Lane = [f32; ROWS];

/// A passage of a piece through one cell, ending at parameter `end` of the piece; it starts where the one before ended.
#[derive(Debug, Clone, Copy)]
pub struct Passage {
    /// Index of the cell among the winding cells of the band.
    pub cell: u32,
    pub end: f32,
}

/// Winding cells of one tile: `(columns + 1) · subrows` lanes, starting at cell `base` of the band.
#[derive(Debug)]
pub struct Grid<'a> {
    /// Signed area differences along x; their running sum is the average winding.
    pub cells: &'a mut [f32],
    pub base: u32,
    pub columns: Columns,
    /// Binary logarithm of the number of sub-rows.
    pub shift: u32,
}

impl Grid<'_> {
    /// Walks a piece through the cells that it crosses, adds its areas and notes its passages.
    ///
    /// A passage spanning `d` rows at mean distance `m` from its cell's left side covers `d·(1 − m)` of the cell and all `d`
    /// of the cells to the right of it, hence `d·m` more from the next cell on.
    pub fn walk(&mut self, p: &Piece, passages: &mut Vec<Passage>) {
        let (right, bottom) = ((self.columns.last - self.columns.first) as i32 - 1, ((ROWS as i32) << self.shift) - 1);
        let x = p.x - self.columns.first as f32;
        let (mut across, mut down) = (Axis::new(x, p.dx), Axis::new(p.y, p.dy));
        let next_column = ROWS << self.shift;
        let mut start = 0.0_f32;
        passages.extend((0..=across.crossings + down.crossings).rev().map(|remaining| {
            let end = if remaining == 0 { 1.0 } else { across.next.min(down.next).clamp(start, 1.0) };
            let (column, row) = (across.cell.clamp(0, right), down.cell.clamp(0, bottom) as usize);
            let subrow = row & ((1 << self.shift) - 1);
            let cell = (((column as usize) << self.shift) + subrow) * ROWS + (row >> self.shift);
            let d = (end - start) * p.dy;
            let m = (x + 0.5 * (start + end) * p.dx - column as f32).clamp(0.0, 1.0);
            self.cells[cell] += d - d * m;
            self.cells[cell + next_column] += d * m;
            start = end;
            let sideways = across.next <= down.next;
            across.advance(sideways);
            down.advance(!sideways);
            Passage { cell: self.base + cell as u32, end }
        }));
    }
}

/// Grid lines of one axis that a piece crosses, one after the other.
struct Axis {
    cell: i32,
    step: i32,
    /// Crossings left at the start.
    crossings: u32,
    /// Parameter of the next crossing.
    next: f32,
    /// Parameter from one crossing to the next.
    pitch: f32,
}

/// A piece advancing less than this along an axis crosses at most one grid line there, at its very end.
const STANDSTILL: f32 = 1e-6;

impl Axis {
    fn new(origin: f32, delta: f32) -> Self {
        if delta.abs() < STANDSTILL {
            return Self { cell: origin.floor() as i32, step: 0, crossings: 0, next: f32::INFINITY, pitch: 0.0 };
        }
        // Seen along the direction of travel: an origin on a grid line belongs to the cell ahead, an end to the cell behind.
        let sign = delta.signum();
        let (from, to) = (sign * origin, sign * (origin + delta));
        let ahead = from.floor();
        let crossings = (to.ceil() - 1.0 - ahead).max(0.0) as u32;
        let pitch = 1.0 / delta.abs();
        let cell = if delta > 0.0 { ahead as i32 } else { -(ahead as i32) - 1 };
        Self { cell, step: sign as i32, crossings, next: (ahead + 1.0 - from) * pitch, pitch }
    }

    /// Branches here would be mispredicted at every other cell.
    fn advance(&mut self, crossed: bool) {
        self.cell += self.step * i32::from(crossed);
        self.next += if crossed { self.pitch } else { 0.0 };
    }
}
