//! Cubic Béziers: evaluation, subdivision, area.

use crate::point::Point;

/// Control points of one segment.
pub type Cubic = [Point; 4];

/// Point at parameter `t`, by de Casteljau.
#[must_use]
pub fn eval(c: &Cubic, t: f64) -> Point {
    split(c, t).0[3]
}

/// Both halves at parameter `t`; they share their joint bitwise (paper, supplement C).
#[must_use]
pub fn split(c: &Cubic, t: f64) -> (Cubic, Cubic) {
    let (ab, bc, cd) = (c[0].lerp(c[1], t), c[1].lerp(c[2], t), c[2].lerp(c[3], t));
    let (abc, bcd) = (ab.lerp(bc, t), bc.lerp(cd, t));
    let joint = abc.lerp(bcd, t);
    ([c[0], ab, abc, joint], [joint, bcd, cd, c[3]])
}

/// Pieces between the ascending parameters `ts` in (0, 1), by recursive subdivision of the remainder.
#[must_use]
pub fn split_at(c: &Cubic, ts: &[f64]) -> Vec<Cubic> {
    let mut pieces = Vec::with_capacity(ts.len() + 1);
    let (mut rest, mut from) = (*c, 0.0);
    for &t in ts {
        let (piece, remainder) = split(&rest, (t - from) / (1.0 - from));
        pieces.push(piece);
        (rest, from) = (remainder, t);
    }
    pieces.push(rest);
    pieces
}

/// Segment `j` of a closed chain `anchor, handle, handle, …`.
#[must_use]
pub fn segment(points: &[Point], j: usize) -> Cubic {
    let first = 3 * j;
    [points[first], points[first + 1], points[first + 2], points[(first + 3) % points.len()]]
}

/// Area enclosed by a closed chain (Green's theorem, exact for cubics), positive when it runs clockwise on screen.
#[must_use]
pub fn signed_area(points: &[Point]) -> f64 {
    let n_segments = points.len() / 3;
    (0..n_segments)
        .map(|j| {
            let [a, b, c, d] = segment(points, j);
            (6.0 * (a.cross(b) + c.cross(d)) + 3.0 * (a.cross(c) + b.cross(c) + b.cross(d)) + a.cross(d)) / 20.0
        })
        .sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    const ARC: Cubic = [Point::new(0.0, 0.0), Point::new(1.0, 4.0), Point::new(5.0, -3.0), Point::new(6.0, 1.0)];

    #[test]
    fn pieces_reevaluate_to_the_source() {
        let ts = [0.1, 0.35, 0.36, 0.9];
        let bounds = [0.0, 0.1, 0.35, 0.36, 0.9, 1.0];
        for (k, piece) in split_at(&ARC, &ts).iter().enumerate() {
            for step in 0..=10 {
                let u = f64::from(step) / 10.0;
                let t = bounds[k] + u * (bounds[k + 1] - bounds[k]);
                assert!(eval(piece, u).distance(eval(&ARC, t)) < 1e-12);
            }
        }
    }

    #[test]
    fn square_of_straight_segments_has_its_area() {
        let corners = [(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)].map(|(x, y)| Point::new(x, y));
        let chain: Vec<Point> = (0..4)
            .flat_map(|i| {
                let (a, b) = (corners[i], corners[(i + 1) % 4]);
                [a, a.lerp(b, 1.0 / 3.0), a.lerp(b, 2.0 / 3.0)]
            })
            .collect();
        assert!((signed_area(&chain) - 4.0).abs() < 1e-12);
    }
}
