//! Python face of what finds places and shapes for new paths.

use super::arrays::{array, flat, refused, shape};
use numpy::{Ix2, PyArray, PyReadonlyArray2, PyReadonlyArray3};
use pyo3::prelude::*;

/// |box mean of weight · residual|² f32 [H, W] over boxes of 2·reach + 1 pixels a side.
#[pyfunction]
pub fn coherent_energy<'py>(
    py: Python<'py>,
    residual: PyReadonlyArray3<'py, f32>,
    weight: PyReadonlyArray2<'py, f32>,
    reach: usize,
) -> PyResult<Bound<'py, PyArray<f32, Ix2>>> {
    let [height, width, _] = shape("residual", &residual, [None, None, Some(3)])?;
    shape("weight", &weight, [Some(height), Some(width)])?;
    let (residual, weight) = (flat("residual", &residual)?, flat("weight", &weight)?);
    let energy = py.detach(|| raster::coherent_energy(residual, weight, (width, height), reach)).map_err(refused)?;
    array(py, energy, [height, width])
}

type Component<'py> = (Bound<'py, PyArray<bool, Ix2>>, Bound<'py, PyArray<f32, Ix2>>);

/// The 4-connected component of `field` f32 [H, W] > `level` around a pixel, and its closed outline f32 [m, 2].
#[pyfunction]
pub fn contour<'py>(
    py: Python<'py>,
    field: PyReadonlyArray2<'py, f32>,
    x: usize,
    y: usize,
    level: f32,
) -> PyResult<Option<Component<'py>>> {
    let [height, width] = shape("field", &field, [None, None])?;
    let found = raster::contour(flat("field", &field)?, (width, height), (x, y), level).map_err(refused)?;
    let Some(component) = found else { return Ok(None) };
    let (points, outline) = (component.outline.len(), component.outline.into_flattened());
    Ok(Some((array(py, component.inside, [height, width])?, array(py, outline, [points, 2])?)))
}
