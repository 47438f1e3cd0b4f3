//! Sorts chords into the bands that they touch.

use crate::flatten::Chords;
use crate::lane::{ROWS, cut, least, most};

/// First vertices of every band's chords, in painter's order.
#[derive(Debug)]
pub struct Bins {
    /// Where each band's vertices start, and the end of the last band's.
    starts: Vec<usize>,
    vertices: Vec<u32>,
}

impl Bins {
    /// Counts, then places: a chord goes to every band between its ends.
    pub fn new(chords: &Chords, height: usize) -> Self {
        let bands = height.div_ceil(ROWS);
        let touched = touched(chords, height, bands);
        let mut starts = vec![0; bands + 1];
        for band in touched.iter().flat_map(|&[first, end]| first..end) {
            starts[band as usize + 1] += 1;
        }
        for band in 0..bands {
            starts[band + 1] += starts[band];
        }
        let mut next = starts.clone();
        let mut vertices = vec![0; starts[bands]];
        for (vertex, &[first, end]) in touched.iter().enumerate() {
            for place in &mut next[usize::from(first)..usize::from(end)] {
                vertices[*place] = vertex as u32;
                *place += 1;
            }
        }
        Self { starts, vertices }
    }

    /// Chords of the band at row `top`.
    pub fn band(&self, top: usize) -> &[u32] {
        let band = top / ROWS;
        &self.vertices[self.starts[band]..self.starts[band + 1]]
    }
}

/// Bands `first..end` that the chord from every vertex touches.
fn touched(chords: &Chords, height: usize, bands: usize) -> Vec<[u16; 2]> {
    let band = |y: f32| (cut(y, 0.0, height as f32) * (1.0 / ROWS as f32)) as i32 as u16;
    let chord = |(&a, &b): (&f32, &f32)| {
        let (low, high) = (least(a, b), most(a, b));
        let end = if high < 0.0 { 0 } else { (band(high) + 1).min(bands as u16) };
        [band(low).min(end), end]
    };
    let mut touched: Vec<_> = chords.y.iter().zip(chords.y.iter().skip(1)).map(chord).collect();
    touched.push([0, 0]);
    for ring in &chords.rings[1..] {
        touched[*ring as usize - 1] = [0, 0];
    }
    touched
}
