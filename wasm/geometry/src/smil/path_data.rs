//! Writes outlines as path data in whole steps, and differences of outlines as path data of the same form.

use crate::point::Point;

/// `d` of a closed chain of cubics as numbers: `m` x y, then x, y of both handles and the end of each segment, relative
/// to the segment's start. Linear in the points, so differences of outlines are differences of numbers.
#[must_use]
pub fn relative_numbers(points: &[Point], step: f64) -> Vec<i64> {
    let steps: Vec<[i64; 2]> = points.iter().map(|p| [whole(p.x / step), whole(p.y / step)]).collect();
    let Some(first) = steps.first() else { return Vec::new() };
    let mut numbers = first.to_vec();
    for segment in 0..steps.len() / 3 {
        let start = steps[3 * segment];
        for k in 1..=3 {
            let point = steps[(3 * segment + k) % steps.len()];
            numbers.extend([point[0] - start[0], point[1] - start[1]]);
        }
    }
    numbers
}

/// Nearest whole number.
#[must_use]
pub fn whole(value: f64) -> i64 {
    value.round() as i64
}

/// Path data of `numbers`: `m1 2c3 4-5…z`; empty for an outline without points.
#[must_use]
pub fn path_data(numbers: &[i64]) -> String {
    if numbers.len() < 2 {
        return String::new();
    }
    format!("m{}c{}z", join(&numbers[..2]), join(&numbers[2..]))
}

/// Whole numbers apart by a space or by the sign of the next.
#[must_use]
pub fn join(numbers: &[i64]) -> String {
    let mut text = String::with_capacity(3 * numbers.len());
    for (i, number) in numbers.iter().enumerate() {
        if i > 0 && *number >= 0 {
            text.push(' ');
        }
        text.push_str(&number.to_string());
    }
    text
}

/// `a − b`, number by number.
#[must_use]
pub fn difference(a: &[i64], b: &[i64]) -> Vec<i64> {
    a.iter().zip(b).map(|(p, q)| p - q).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn triangle(shift: f64) -> Vec<Point> {
        (0..9).map(|i| Point::new(f64::from(i) * 1.5 + shift, f64::from(i * i) - shift)).collect()
    }

    #[test]
    fn rounding_does_not_add_up_along_the_outline() {
        let points: Vec<Point> = (0..30).map(|i| Point::new(f64::from(i) * 0.3, 0.0)).collect();
        let numbers = relative_numbers(&points, 1.0);
        let ends: i64 = numbers[2..].chunks(6).map(|segment| segment[4]).sum();
        assert_eq!(ends, 0, "the outline must close");
        let last_start: i64 = numbers[2..].chunks(6).take(9).map(|segment| segment[4]).sum();
        assert_eq!(last_start, 8, "27 · 0.3 = 8.1");
    }

    #[test]
    fn shift_changes_only_the_start() {
        let difference = difference(&relative_numbers(&triangle(4.0), 1.0), &relative_numbers(&triangle(0.0), 1.0));
        assert_eq!(difference[..2], [4, -4]);
        assert!(difference[2..].iter().all(|n| *n == 0));
    }

    #[test]
    fn signs_separate_numbers() {
        assert_eq!(path_data(&[1, -2, 3, 4, -5, 6, 0, 0]), "m1-2c3 4-5 6 0 0z");
    }
}
