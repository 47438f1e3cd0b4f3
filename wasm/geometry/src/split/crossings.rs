//! Where a cubic crosses a straight edge.

use crate::cubic::Cubic;
use crate::point::Point;

/// A crossing: parameter on the curve, parameter along the edge (0 at its start, 1 at its end).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    pub t: f64,
    pub s: f64,
}

/// Crossings closer than this to an end of the curve, or to each other, are not separate.
pub const PARAMETER_TOLERANCE: f64 = 1e-6;

/// Appends the crossings of `curve` with the edge from `a` to `b` to `out`, ascending in t, without repeats.
///
/// The signed distance from the edge's line is a cubic in Bernstein form. Its sign changes are bracketed by the roots of its
/// derivative and found by a Newton iteration that falls back on bisection. Touching without crossing does not count.
pub fn push_crossings(curve: &Cubic, a: Point, b: Point, out: &mut Vec<Crossing>) {
    let along = b - a;
    let length_squared = along.dot(along);
    if length_squared == 0.0 {
        return;
    }
    let distance = curve.map(|p| along.cross(p - a));
    if distance.iter().all(|&d| d >= 0.0) || distance.iter().all(|&d| d <= 0.0) {
        return;
    }
    let place = curve.map(|p| along.dot(p - a) / length_squared);
    let (before, beyond) = (-PARAMETER_TOLERANCE, 1.0 + PARAMETER_TOLERANCE);
    if place.iter().all(|&s| s < before) || place.iter().all(|&s| s > beyond) {
        return;
    }
    let mut from = (0.0, distance[0]);
    for t in monotone_ends(&distance).into_iter().flatten().chain([1.0]) {
        let to = (t, bernstein(&distance, t));
        if from.1 * to.1 < 0.0 {
            let root = bracketed_root(&distance, from, to);
            let s = bernstein(&place, root);
            let inside = root > PARAMETER_TOLERANCE && root < 1.0 - PARAMETER_TOLERANCE;
            if inside && (before..=beyond).contains(&s) {
                out.push(Crossing { t: root, s: s.clamp(0.0, 1.0) });
            }
        }
        from = to;
    }
}

/// Value at `t` of a cubic in Bernstein form.
fn bernstein(c: &[f64; 4], t: f64) -> f64 {
    let u = 1.0 - t;
    u * u * (u * c[0] + 3.0 * t * c[1]) + t * t * (3.0 * u * c[2] + t * c[3])
}

/// Interior extrema of a cubic in Bernstein form, ascending; the quadratic formula without cancellation.
fn monotone_ends(c: &[f64; 4]) -> [Option<f64>; 2] {
    let (e0, e1, e2) = (c[1] - c[0], c[2] - c[1], c[3] - c[2]);
    let (qa, qb, qc) = (e0 - 2.0 * e1 + e2, 2.0 * (e1 - e0), e0);
    let discriminant = qb * qb - 4.0 * qa * qc;
    if discriminant <= 0.0 {
        return [None, None];
    }
    let q = -0.5 * (qb + discriminant.sqrt().copysign(qb));
    let inside = |t: f64| (t > 0.0 && t < 1.0).then_some(t);
    match (inside(q / qa), inside(qc / q)) {
        (Some(first), Some(second)) => [Some(first.min(second)), Some(first.max(second))],
        (first, second) => [first.or(second), None],
    }
}

/// Root between two parameters whose values differ in sign, to the last bits of t.
fn bracketed_root(c: &[f64; 4], mut low: (f64, f64), mut high: (f64, f64)) -> f64 {
    let mut t = low.0 + (high.0 - low.0) * low.1 / (low.1 - high.1);
    for _ in 0..MAX_ITERATIONS {
        let value = bernstein(c, t);
        if value == 0.0 {
            return t;
        }
        if value.is_sign_negative() == low.1.is_sign_negative() {
            low = (t, value);
        } else {
            high = (t, value);
        }
        let u = 1.0 - t;
        let slope = 3.0 * (u * u * (c[1] - c[0]) + 2.0 * u * t * (c[2] - c[1]) + t * t * (c[3] - c[2]));
        let newton = t - value / slope;
        let next = if newton > low.0 && newton < high.0 { newton } else { low.0.midpoint(high.0) };
        if (next - t).abs() <= f64::EPSILON {
            return next;
        }
        t = next;
    }
    t
}

/// Bisection alone needs 53 halvings of [0, 1]; Newton usually ends after five.
const MAX_ITERATIONS: usize = 80;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cubic::eval;
    use proptest::prelude::*;

    const ARCH: Cubic = [Point::new(0.0, 0.0), Point::new(0.0, 4.0), Point::new(4.0, 4.0), Point::new(4.0, 0.0)];

    fn crossings(curve: &Cubic, a: (f64, f64), b: (f64, f64)) -> Vec<Crossing> {
        let mut out = Vec::new();
        push_crossings(curve, Point::new(a.0, a.1), Point::new(b.0, b.1), &mut out);
        out
    }

    #[test]
    fn vertical_edge_through_the_middle_of_an_arch_crosses_once_at_one_half() {
        let found = crossings(&ARCH, (2.0, 0.0), (2.0, 6.0));
        assert_eq!(found.len(), 1);
        assert!((found[0].t - 0.5).abs() < 1e-15 && (found[0].s - 0.5).abs() < 1e-15);
    }

    #[test]
    fn edge_touching_the_top_is_no_crossing() {
        assert!(crossings(&ARCH, (-1.0, 3.0), (5.0, 3.0)).is_empty());
    }

    #[test]
    fn edge_that_ends_before_the_curve_is_no_crossing() {
        assert!(crossings(&ARCH, (2.0, 0.0), (2.0, 2.9)).is_empty());
    }

    #[test]
    fn curve_along_the_edge_is_no_crossing() {
        let line = [0.0, 1.0, 2.0, 3.0].map(|x| Point::new(x, 1.0));
        assert!(crossings(&line, (0.0, 1.0), (3.0, 1.0)).is_empty());
    }

    fn point() -> impl Strategy<Value = Point> {
        (-10.0..10.0, -10.0..10.0).prop_map(|(x, y)| Point::new(x, y))
    }

    proptest! {
        #[test]
        fn crossings_lie_on_both_and_match_dense_sampling(curve in [point(), point(), point(), point()], a in point(), b in point()) {
            prop_assume!(a.distance(b) > 0.1);
            let mut found = Vec::new();
            push_crossings(&curve, a, b, &mut found);
            for crossing in &found {
                prop_assert!(eval(&curve, crossing.t).distance(a.lerp(b, crossing.s)) < 1e-5);
            }
            // Oracle: sign changes of the distance between dense samples, well inside the edge.
            let side = |t: f64| (b - a).cross(eval(&curve, t) - a);
            for step in 0..2000 {
                let (t0, t1) = (f64::from(step) / 2000.0, f64::from(step + 1) / 2000.0);
                let s = (b - a).dot(eval(&curve, t0.midpoint(t1)) - a) / (b - a).dot(b - a);
                if side(t0) * side(t1) < 0.0 && (0.1..0.9).contains(&s) && step > 0 && step < 1999 {
                    prop_assert!(found.iter().any(|c| c.t >= t0 - 1e-9 && c.t <= t1 + 1e-9));
                }
            }
        }
    }
}
