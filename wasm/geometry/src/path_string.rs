//! Writes closed cubic chains as SVG path data.

use crate::point::Point;

/// Characters of the longest number, with its sign or the space before it.
const LONGEST: usize = 13;

/// Appends `M x y c … Z`: points rounded to 1/100 px, every cubic relative to the rounded anchor it starts from, so that
/// rounding does not add up along the chain. Numbers have no trailing zeros, and no zero before the point.
///
/// The command list depends on the number of points only, so that all frames of a path interpolate.
pub fn push_path(points: &[Point], out: &mut Vec<u8>) {
    let Some(&first) = points.first() else {
        return;
    };
    let start = out.len();
    out.resize(start + LONGEST * (2 * points.len() + 2) + 3, b'Z');
    let mut text = Text { bytes: &mut out[start..], length: 0 };
    let mut anchor = hundredths(first);
    text.put(b'M');
    text.put_pair(anchor, false);
    text.put(b'c');
    for (index, &p) in points[1..].iter().chain([&first]).enumerate() {
        let [x, y] = hundredths(p);
        text.put_pair([x.saturating_sub(anchor[0]), y.saturating_sub(anchor[1])], index > 0);
        if index % 3 == 2 {
            anchor = [x, y];
        }
    }
    text.put(b'Z');
    let end = start + text.length;
    out.truncate(end);
}

/// Path data of one closed chain.
#[must_use]
pub fn path_string(points: &[Point]) -> String {
    let mut out = Vec::new();
    push_path(points, &mut out);
    String::from_utf8(out).unwrap_or_default()
}

/// Coordinates in hundredths of a pixel; those beyond ±21 million pixels stop there.
fn hundredths(p: Point) -> [i32; 2] {
    [p.x, p.y].map(|value| (value * 100.0 + 0.5).floor() as i32)
}

/// The filled part of a buffer that is long enough.
struct Text<'a> {
    bytes: &'a mut [u8],
    length: usize,
}

impl Text<'_> {
    fn put(&mut self, character: u8) {
        self.bytes[self.length] = character;
        self.length += 1;
    }

    fn put_pair(&mut self, [x, y]: [i32; 2], separate: bool) {
        self.put_number(x, separate);
        self.put_number(y, true);
    }

    fn put_number(&mut self, hundredths: i32, separate: bool) {
        if hundredths < 0 {
            self.put(b'-');
        } else if separate {
            self.put(b' ');
        }
        let magnitude = hundredths.unsigned_abs();
        let (whole, fraction) = (magnitude / 100, (magnitude % 100) as u8);
        if whole > 0 || fraction == 0 {
            self.put_integer(whole);
        }
        if fraction > 0 {
            self.put(b'.');
            self.put(b'0' + fraction / 10);
            if !fraction.is_multiple_of(10) {
                self.put(b'0' + fraction % 10);
            }
        }
    }

    fn put_integer(&mut self, mut value: u32) {
        let last = value.checked_ilog10().unwrap_or(0) as usize;
        for place in (0..=last).rev() {
            self.bytes[self.length + place] = b'0' + (value % 10) as u8;
            value /= 10;
        }
        self.length += last + 1;
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may stop at what it cannot read")]

    use super::*;
    use proptest::prelude::*;

    #[test]
    fn numbers_are_rounded_and_stripped() {
        let points = [(0.0, -0.004), (1.5, -2.25), (10.999, 0.5)].map(|(x, y)| Point::new(x, y));
        assert_eq!(path_string(&points), "M0 0c1.5-2.25 11 .5 0 0Z");
    }

    #[test]
    fn cubics_start_where_the_one_before_ends() {
        let chain =
            [(1.0, 1.0), (2.0, 1.0), (3.0, 1.0), (4.0, 1.0), (3.0, 2.0), (2.0, 2.0)].map(|(x, y)| Point::new(x, y));
        assert_eq!(path_string(&chain), "M1 1c1 0 2 0 3 0-1 1-2 1-3 0Z");
    }

    #[test]
    fn no_points_give_no_commands() {
        assert_eq!(path_string(&[]), "");
    }

    #[test]
    fn the_longest_numbers_fit() {
        let far = [Point::new(-1e9, 1e9), Point::new(1e9, -1e9), Point::new(-1e9, -1e9)];
        assert_eq!(path_string(&far), "M-21474836.48 21474836.47c21474836.47-21474836.48 0-21474836.48 0 0Z");
    }

    /// Absolute points of path data as `push_path` writes it.
    fn read(text: &str) -> Vec<[f64; 2]> {
        let (start, rest) = text[1..text.len() - 1].split_once('c').unwrap();
        let pairs = |text: &str| -> Vec<[f64; 2]> {
            let numbers: Vec<f64> =
                text.replace('-', " -").split_whitespace().map(|number| number.parse().unwrap()).collect();
            numbers.chunks(2).map(|pair| [pair[0], pair[1]]).collect()
        };
        let mut points = pairs(start);
        let mut anchor = points[0];
        for (index, [dx, dy]) in pairs(rest).into_iter().enumerate() {
            points.push([anchor[0] + dx, anchor[1] + dy]);
            if index % 3 == 2 {
                anchor = points[index + 1];
            }
        }
        points
    }

    proptest! {
        #[test]
        fn every_point_is_read_back_within_half_a_hundredth(
            flat in proptest::collection::vec((-3000.0..3000.0, -3000.0..3000.0), 1..9),
        ) {
            let chain: Vec<Point> = flat.iter().cycle().take(3 * flat.len()).map(|&(x, y)| Point::new(x, y)).collect();
            let back = read(&path_string(&chain));
            prop_assert_eq!(back.len(), chain.len() + 1);
            for (p, [x, y]) in chain.iter().chain([&chain[0]]).zip(back) {
                prop_assert!((p.x - x).abs() < 0.005_001 && (p.y - y).abs() < 0.005_001, "{:?} {} {}", p, x, y);
            }
        }
    }
}
