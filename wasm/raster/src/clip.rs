//! Finds the columns that a path's chords cross in a band.

use crate::flatten::Chords;
use crate::line::{Line, Window};
use crate::marks::Marks;

/// A chord of which some part is inside the band and not right of the canvas.
#[derive(Debug, Clone, Copy)]
pub struct Piece {
    pub line: Line,
    /// First vertex of the chord.
    pub vertex: u32,
    /// Columns of the frame that it crosses: none if the whole part lies left of the canvas.
    pub first: u32,
    pub last: u32,
    /// Parts of it lie left of the canvas, where they wind but no pixel sees them move; right of the canvas.
    pub left: bool,
    pub right: bool,
    /// Winding cell of the first column.
    pub cell: u32,
}

impl Piece {
    pub fn columns(&self) -> usize {
        (self.last - self.first) as usize
    }
}

/// Appends the pieces of a path's chords, marks the columns where they change the winding, and tells whether the path reaches
/// over the right border, so that the last winding goes on to there.
pub fn clip(chords: &Chords, vertices: &[u32], window: Window, pieces: &mut Vec<Piece>, marks: &mut Marks) -> bool {
    let mut beyond = false;
    let width = window.width as f32;
    for &vertex in vertices {
        let line = Line::new(chords, vertex as usize, window);
        let Some((low, high)) = line.extent(window) else { continue };
        let right = high > width;
        beyond |= right;
        if low > width {
            continue;
        }
        let last = if high < 0.0 { 0 } else { (high as i32 as u32 + 1).min(window.width as u32) };
        let first = (low.max(0.0) as i32 as u32).min(last.saturating_sub(1));
        marks.insert(first as usize, last as usize);
        pieces.push(Piece { line, vertex, first, last, left: low < 0.0, right, cell: 0 });
    }
    beyond
}
