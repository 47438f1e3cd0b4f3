//! Turns a field into the outline of the part around a pixel that lies above a level.

use crate::error::Error;
use crate::scene::{MAX_SIDE, length, size};
use std::cmp::Ordering;

/// Values outside a component count as at least this much below the level, so that its outline passes between pixels.
const LEAST_DROP: f32 = 1e-3;

/// A 4-connected set of pixels.
#[derive(Debug, Clone, PartialEq)]
pub struct Component {
    /// Whether a pixel belongs to it, `[height, width]`.
    pub inside: Vec<bool>,
    /// Its outer border as a closed polygon x, y, clockwise on the screen, without a repeated point; pixel centres are integers.
    pub outline: Vec<[f32; 2]>,
}

/// The component of `field [height, width] > level` that holds the pixel `start` (x, y); nothing if that one is not above it.
///
/// The outline crosses each side between a pixel inside and one outside where the field, interpolated, has the level: that is
/// marching squares with high pixels 4-connected.
pub fn contour(
    field: &[f32],
    (width, height): (usize, usize),
    start: (usize, usize),
    level: f32,
) -> Result<Option<Component>, Error> {
    size("width", width, 1, MAX_SIDE)?;
    size("height", height, 1, MAX_SIDE)?;
    length("field", field, width * height)?;
    size("x", start.0, 0, width - 1)?;
    size("y", start.1, 0, height - 1)?;
    let inside = flood(field, width, start.1 * width + start.0, level);
    Ok(inside.iter().position(|own| *own).map(|first| {
        let grid = Grid { field, inside: &inside, width: width as isize, height: height as isize, level };
        let outline = grid.trace((first % width) as isize, (first / width) as isize);
        Component { inside, outline }
    }))
}

fn flood(field: &[f32], width: usize, start: usize, level: f32) -> Vec<bool> {
    let mut inside = vec![false; field.len()];
    let mut open = vec![start];
    while let Some(i) = open.pop() {
        if inside[i] || field[i].partial_cmp(&level) != Some(Ordering::Greater) {
            continue;
        }
        inside[i] = true;
        let x = i % width;
        open.extend([(x > 0).then(|| i - 1), (x + 1 < width).then_some(i + 1)].into_iter().flatten());
        open.extend([i.checked_sub(width), Some(i + width).filter(|below| *below < field.len())].into_iter().flatten());
    }
    inside
}

struct Grid<'a> {
    field: &'a [f32],
    inside: &'a [bool],
    width: isize,
    height: isize,
    level: f32,
}

impl Grid<'_> {
    fn at(&self, x: isize, y: isize) -> Option<usize> {
        let within = (0..self.width).contains(&x) && (0..self.height).contains(&y);
        within.then_some((y * self.width + x) as usize)
    }

    fn is_inside(&self, x: isize, y: isize) -> bool {
        self.at(x, y).is_some_and(|i| self.inside[i])
    }

    /// Follows the sides between inside and outside clockwise from the upper one of the highest pixel (x, y).
    fn trace(&self, x: isize, y: isize) -> Vec<[f32; 2]> {
        let start = ((x, y), (0, -1));
        let ((mut x, mut y), (mut out_x, mut out_y)) = start;
        let mut outline = Vec::new();
        loop {
            outline.push(self.crossing((x, y), (out_x, out_y)));
            let (ahead_x, ahead_y) = (-out_y, out_x);
            if !self.is_inside(x + ahead_x, y + ahead_y) {
                (out_x, out_y) = (ahead_x, ahead_y);
            } else {
                (x, y) = (x + ahead_x, y + ahead_y);
                if self.is_inside(x + out_x, y + out_y) {
                    (x, y) = (x + out_x, y + out_y);
                    (out_x, out_y) = (-ahead_x, -ahead_y);
                }
            }
            if ((x, y), (out_x, out_y)) == start {
                return outline;
            }
        }
    }

    /// Where the field has the level between a pixel inside and its neighbour outside; half-way to one beyond the border.
    fn crossing(&self, (x, y): (isize, isize), out: (isize, isize)) -> [f32; 2] {
        let height = |at: Option<usize>| at.map(|i| self.field[i] - self.level);
        let above = height(self.at(x, y)).unwrap_or(LEAST_DROP);
        let below = height(self.at(x + out.0, y + out.1)).unwrap_or(-above).min(-LEAST_DROP);
        let share = above / (above - below);
        [x as f32 + share * out.0 as f32, y as f32 + share * out.1 as f32]
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, clippy::expect_used)] // a failed unwrap is a failed test
mod tests {
    use super::*;

    #[test]
    fn outline_of_a_lone_pixel_crosses_its_four_sides_where_the_field_has_the_level() {
        let field = [0.0, 0.0, 0.0, 0.0, 1.0, -1.0, 0.0, 0.0, 1.0]; // the lower right pixel touches at a corner only
        let found = contour(&field, (3, 3), (1, 1), 0.5).unwrap().unwrap();
        assert_eq!(found.inside.iter().filter(|own| **own).count(), 1);
        assert_eq!(found.outline, [[1.0, 0.5], [1.25, 1.0], [1.0, 1.5], [0.5, 1.0]]);
    }

    #[test]
    fn outline_leaves_holes_out() {
        let ring = [1.0, 1.0, 1.0, 1.0, 0.0, 1.0, 1.0, 1.0, 1.0];
        let found = contour(&ring, (3, 3), (0, 0), 0.5).unwrap().unwrap();
        assert_eq!(found.outline.len(), 12);
        assert!(!found.inside[4]);
    }

    #[test]
    fn start_outside_the_field_is_refused() {
        assert!(contour(&[1.0; 4], (2, 2), (2, 0), 0.5).is_err());
    }
}
