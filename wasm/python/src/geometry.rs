//! Python face of the `geometry` crate.

use geometry::opening::{self, N_LANDMARKS};
use geometry::point::Point;
use numpy::{IntoPyArray, PyArray2, PyArrayMethods, PyReadonlyArray2};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

type Outline<'py> = (&'static str, Bound<'py, PyArray2<f64>>, bool);

/// Outlines of the eye and mouth openings of 68 landmarks at rest: `(name, points[3S, 2], closed)`.
#[pyfunction]
fn opening_outlines<'py>(
    py: Python<'py>,
    landmarks: PyReadonlyArray2<'py, f64>,
) -> PyResult<Vec<Outline<'py>>> {
    opening::rest_outlines(&landmark_points(&landmarks)?)
        .into_iter()
        .map(|outline| {
            Ok((
                outline.opening.name(),
                pairs(py, &outline.points)?,
                outline.closed,
            ))
        })
        .collect()
}

fn points(array: &PyReadonlyArray2<f64>) -> PyResult<Vec<Point>> {
    let view = array.as_array();
    if view.ncols() != 2 {
        return Err(PyValueError::new_err(format!(
            "expected (x, y) rows, got {} columns",
            view.ncols()
        )));
    }
    Ok(view
        .rows()
        .into_iter()
        .map(|row| Point::new(row[0], row[1]))
        .collect())
}

fn landmark_points(array: &PyReadonlyArray2<f64>) -> PyResult<[Point; N_LANDMARKS]> {
    points(array)?.try_into().map_err(|points: Vec<Point>| {
        PyValueError::new_err(format!(
            "expected {N_LANDMARKS} landmarks, got {}",
            points.len()
        ))
    })
}

fn pairs<'py>(py: Python<'py>, points: &[Point]) -> PyResult<Bound<'py, PyArray2<f64>>> {
    geometry::point::to_flat(points)
        .into_pyarray(py)
        .reshape([points.len(), 2])
}

pub fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_function(wrap_pyfunction!(opening_outlines, module)?)
}
