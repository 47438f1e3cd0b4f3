//! Fits 68 landmarks to five pins, for portraits in which no face was found.
//!
//! A template face is laid on the pins by the best similarity; what the pins miss is spread to nearby points by Gaussian
//! radial basis functions, so that the pins are met exactly.

use crate::face::{Iris, Landmarks};
use crate::opening::N_LANDMARKS;
use crate::point::Point;

/// Image-left eye, image-right eye, nose tip, image-left and image-right mouth corner.
pub type Pins = [Point; N_PINS];

const N_PINS: usize = 5;

/// Width of the correction's Gaussians, in outer-eye distances.
const SPREAD: f64 = 0.2;

/// Iris radius in outer-eye distances.
const IRIS_RADIUS: f64 = 0.065;

/// Symmetric mean of the faces that the mesh model finds in the development portraits; the origin lies between the
/// outer eye corners, whose distance is 1; x to the right, y down.
const TEMPLATE: [[f64; 2]; N_LANDMARKS] = [
    [-0.760, -0.042],
    [-0.751, 0.161],
    [-0.726, 0.348],
    [-0.692, 0.534],
    [-0.613, 0.738],
    [-0.472, 0.922],
    [-0.359, 1.015],
    [-0.204, 1.107],
    [0.000, 1.148],
    [0.204, 1.107],
    [0.359, 1.015],
    [0.472, 0.922],
    [0.613, 0.738],
    [0.692, 0.534],
    [0.726, 0.348],
    [0.751, 0.161],
    [0.760, -0.042],
    [-0.614, -0.154],
    [-0.545, -0.209],
    [-0.445, -0.239],
    [-0.273, -0.224],
    [-0.155, -0.205],
    [0.155, -0.205],
    [0.273, -0.224],
    [0.445, -0.239],
    [0.545, -0.209],
    [0.614, -0.154],
    [0.000, -0.016],
    [0.000, 0.089],
    [0.000, 0.198],
    [0.000, 0.361],
    [-0.151, 0.464],
    [-0.088, 0.478],
    [0.000, 0.483],
    [0.088, 0.478],
    [0.151, 0.464],
    [-0.500, 0.000],
    [-0.428, -0.044],
    [-0.314, -0.050],
    [-0.198, 0.022],
    [-0.294, 0.043],
    [-0.405, 0.045],
    [0.198, 0.022],
    [0.314, -0.050],
    [0.428, -0.044],
    [0.500, 0.000],
    [0.405, 0.045],
    [0.294, 0.043],
    [-0.273, 0.690],
    [-0.200, 0.653],
    [-0.084, 0.627],
    [0.000, 0.641],
    [0.084, 0.627],
    [0.200, 0.653],
    [0.273, 0.690],
    [0.200, 0.771],
    [0.104, 0.820],
    [0.000, 0.835],
    [-0.104, 0.820],
    [-0.200, 0.771],
    [-0.248, 0.692],
    [-0.127, 0.687],
    [0.000, 0.695],
    [0.127, 0.687],
    [0.248, 0.692],
    [0.127, 0.729],
    [0.000, 0.744],
    [-0.127, 0.729],
];

/// Landmarks and irises of a face with these pins; `None` when the pins coincide or are not finite.
#[must_use]
pub fn fit_pins(pins: &Pins) -> Option<(Landmarks, [Iris; 2])> {
    let template = TEMPLATE.map(|[x, y]| Point::new(x, y));
    let sources = pins_of(&template);
    let (factor, shift) = similarity(&sources, pins)?;
    let laid = |p: Point| p.complex_mul(factor) + shift;
    let residuals: Vec<Point> = pins.iter().zip(&sources).map(|(&pin, &source)| pin - laid(source)).collect();
    let weights = interpolation_weights(&sources, residuals)?;
    let fitted = |p: Point| {
        let correction = sources.iter().zip(&weights).fold(Point::ZERO, |sum, (&s, &w)| sum + w * kernel(p, s));
        laid(p) + correction
    };
    let landmarks = template.map(fitted);
    let irises = [pins[0], pins[1]].map(|centre| Iris { centre, radius: IRIS_RADIUS * factor.norm() });
    Some((landmarks, irises))
}

/// The pins of a face whose landmarks are known: centres of the eyes, 30, 48, 54.
#[must_use]
pub fn pins_of(landmarks: &Landmarks) -> Pins {
    let eye = |first: usize| (first..first + 6).fold(Point::ZERO, |sum, i| sum + landmarks[i]) * (1.0 / 6.0);
    [eye(36), eye(42), landmarks[30], landmarks[48], landmarks[54]]
}

/// Least-squares similarity z ↦ factor · z + shift between point lists, as complex numbers.
fn similarity(from: &Pins, to: &Pins) -> Option<(Point, Point)> {
    let centre = |points: &Pins| points.iter().fold(Point::ZERO, |sum, &p| sum + p) * (1.0 / N_PINS as f64);
    let (from_centre, to_centre) = (centre(from), centre(to));
    let (mut moment, mut spread) = (Point::ZERO, 0.0);
    for (&a, &b) in from.iter().zip(to) {
        let (a, b) = (a - from_centre, b - to_centre);
        moment += b.complex_mul(Point::new(a.x, -a.y));
        spread += a.dot(a);
    }
    let factor = moment * (1.0 / spread);
    (factor.is_finite() && factor.norm() > 0.0).then(|| (factor, to_centre - from_centre.complex_mul(factor)))
}

fn kernel(p: Point, centre: Point) -> f64 {
    let distance = p.distance(centre) / SPREAD;
    (-0.5 * distance * distance).exp()
}

/// Weights with which kernels at `centres` interpolate `values` (Gaussian elimination with pivoting).
fn interpolation_weights(centres: &Pins, mut values: Vec<Point>) -> Option<Vec<Point>> {
    let mut matrix = centres.map(|row| centres.map(|column| kernel(row, column)));
    for column in 0..N_PINS {
        let pivot = (column..N_PINS).max_by(|&a, &b| matrix[a][column].abs().total_cmp(&matrix[b][column].abs()))?;
        matrix.swap(column, pivot);
        values.swap(column, pivot);
        for row in 0..N_PINS {
            if row != column {
                let factor = matrix[row][column] / matrix[column][column];
                let pivot_row = matrix[column];
                for (entry, above) in matrix[row].iter_mut().zip(pivot_row) {
                    *entry -= factor * above;
                }
                let above = values[column];
                values[row] = values[row] - above * factor;
            }
        }
    }
    Some(values.iter().enumerate().map(|(row, &value)| value * (1.0 / matrix[row][row])).collect())
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a failed fit fails the test")]
    use super::*;

    #[test]
    fn template_fits_its_own_pins() {
        let template = TEMPLATE.map(|[x, y]| Point::new(x, y));
        let (landmarks, _) = fit_pins(&pins_of(&template)).unwrap();
        for (fitted, wanted) in landmarks.iter().zip(template) {
            assert!(fitted.distance(wanted) < 1e-9);
        }
    }

    #[test]
    fn pins_are_met_wherever_they_are() {
        let pins = [(100.0, 120.0), (190.0, 100.0), (160.0, 170.0), (120.0, 220.0), (200.0, 205.0)];
        let pins = pins.map(|(x, y)| Point::new(x, y));
        let (landmarks, irises) = fit_pins(&pins).unwrap();
        for (corner, pin) in [(30, 2), (48, 3), (54, 4)] {
            assert!(landmarks[corner].distance(pins[pin]) < 1e-9);
        }
        assert_eq!(irises[0].centre, pins[0]);
    }

    #[test]
    fn coinciding_pins_fit_nothing() {
        assert!(fit_pins(&[Point::new(3.0, 4.0); 5]).is_none());
    }
}
