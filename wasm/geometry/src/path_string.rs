//! Writes closed cubic chains as SVG path data.

use crate::point::Point;

/// Appends `M x y C … Z` with absolute coordinates rounded to 1/100 px, without trailing zeros.
///
/// The command list depends on the number of points only, so that all frames of a path interpolate.
pub fn push_path(points: &[Point], out: &mut Vec<u8>) {
    let Some(&first) = points.first() else {
        return;
    };
    out.push(b'M');
    push_number(first.x, false, out);
    push_number(first.y, true, out);
    out.push(b'C');
    let mut separate = false;
    for p in points[1..].iter().chain([&first]) {
        push_number(p.x, separate, out);
        push_number(p.y, true, out);
        separate = true;
    }
    out.push(b'Z');
}

/// Path data of one closed chain.
#[must_use]
pub fn path_string(points: &[Point]) -> String {
    let mut out = Vec::with_capacity(16 * points.len());
    push_path(points, &mut out);
    String::from_utf8(out).unwrap_or_default()
}

fn push_number(value: f64, separate: bool, out: &mut Vec<u8>) {
    let hundredths = (value * 100.0).round() as i64;
    if hundredths < 0 {
        out.push(b'-');
    } else if separate {
        out.push(b' ');
    }
    let magnitude = hundredths.unsigned_abs();
    push_integer(magnitude / 100, out);
    let fraction = (magnitude % 100) as u8;
    if fraction > 0 {
        out.extend_from_slice(&[b'.', b'0' + fraction / 10]);
        if !fraction.is_multiple_of(10) {
            out.push(b'0' + fraction % 10);
        }
    }
}

fn push_integer(mut value: u64, out: &mut Vec<u8>) {
    let mut digits = [0u8; 20];
    let mut from = digits.len();
    loop {
        from -= 1;
        digits[from] = b'0' + (value % 10) as u8;
        value /= 10;
        if value == 0 {
            break;
        }
    }
    out.extend_from_slice(&digits[from..]);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_rounded_and_stripped() {
        let points = [(0.0, -0.004), (1.5, -2.25), (10.999, 100.0)].map(|(x, y)| Point::new(x, y));
        assert_eq!(path_string(&points), "M0 0C1.5-2.25 11 100 0 0Z");
    }

    #[test]
    fn no_points_give_no_commands() {
        assert_eq!(path_string(&[]), "");
    }
}
