//! Python face of the optimiser's step.

use super::arrays::{flat, refused};
use numpy::{PyReadonlyArray1, PyReadonlyArrayDyn, PyReadwriteArrayDyn};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use raster::{Adam, Rule};

/// One step of Adam on `values` f32 [n, …] in place, with their moments.
#[pyfunction]
#[allow(clippy::too_many_arguments)] // one flat array each: the border's rule
pub fn adam_step(
    mut values: PyReadwriteArrayDyn<'_, f32>,
    gradient: PyReadonlyArrayDyn<'_, f32>,
    mut first: PyReadwriteArrayDyn<'_, f32>,
    mut second: PyReadwriteArrayDyn<'_, f32>,
    age: PyReadonlyArray1<'_, i64>,
    rate: PyReadonlyArray1<'_, f32>,
    least: PyReadonlyArray1<'_, f32>,
    most: PyReadonlyArray1<'_, f32>,
    betas: [f32; 2],
    epsilon: f32,
) -> PyResult<()> {
    let rule =
        Rule { rate: flat("rate", &rate)?, least: flat("least", &least)?, most: flat("most", &most)?, betas, epsilon };
    let mut adam =
        Adam { values: writable(&mut values)?, first: writable(&mut first)?, second: writable(&mut second)? };
    adam.step(flat("gradient", &gradient)?, flat("age", &age)?, &rule).map_err(refused)
}

fn writable<'a>(array: &'a mut PyReadwriteArrayDyn<'_, f32>) -> PyResult<&'a mut [f32]> {
    array.as_slice_mut().map_err(|_| PyValueError::new_err("parameters and moments must be C-contiguous."))
}
