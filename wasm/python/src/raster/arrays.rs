//! Numpy arrays checked by shape and seen as slices, and vectors given back as arrays.

use numpy::ndarray::{Dimension, IntoDimension};
use numpy::{
    Element, IntoPyArray, PyArray, PyArrayMethods, PyReadonlyArray, PyReadonlyArray1, PyReadonlyArray2,
    PyReadonlyArray3, PyUntypedArrayMethods,
};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use raster::{Frame, Paths};

/// Arrays of a call as Python gives them.
pub struct Scene<'py> {
    pub points: PyReadonlyArray3<'py, f32>,
    pub stops: PyReadonlyArray3<'py, f32>,
    pub axis: PyReadonlyArray2<'py, f32>,
    pub gradient: Vec<bool>,
    pub clip: PyReadonlyArray1<'py, i32>,
    pub clips: PyReadonlyArray3<'py, f32>,
    pub canvas: PyReadonlyArray1<'py, f32>,
    pub width: usize,
    pub height: usize,
    pub subrows: usize,
    pub flatness: f32,
    pub quantise: bool,
}

impl Scene<'_> {
    pub fn paths(&self) -> PyResult<Paths<'_>> {
        let [n, controls, _] = shape("points", &self.points, [None, None, Some(2)])?;
        if controls == 0 || controls % 3 != 0 {
            return Err(PyValueError::new_err(format!(
                "points has {controls} control points a path; the count must be a positive multiple of 3."
            )));
        }
        shape("stops", &self.stops, [Some(n), Some(raster::STOPS), Some(4)])?;
        shape("axis", &self.axis, [Some(n), Some(4)])?;
        shape("clip", &self.clip, [Some(n)])?;
        if self.gradient.len() != n {
            return Err(PyValueError::new_err(format!("gradient has {} values; expected {n}.", self.gradient.len())));
        }
        Ok(Paths {
            segments: controls / 3,
            points: flat("points", &self.points)?,
            stops: flat("stops", &self.stops)?,
            axis: flat("axis", &self.axis)?,
            gradient: &self.gradient,
            clip: flat("clip", &self.clip)?,
        })
    }

    pub fn frame(&self) -> PyResult<Frame<'_>> {
        let (width, height) = (self.width, self.height);
        let [masks, ..] = shape("clips", &self.clips, [None, None, None])?;
        if masks > 0 {
            shape("clips", &self.clips, [None, Some(height), Some(width)])?;
        }
        shape("canvas", &self.canvas, [Some(3)])?;
        let c = flat("canvas", &self.canvas)?;
        let clips = flat("clips", &self.clips)?;
        let (subrows, flatness, quantise) = (self.subrows, self.flatness, self.quantise);
        Ok(Frame { width, height, canvas: [c[0], c[1], c[2]], clips, subrows, flatness, quantise })
    }
}

/// A boolean array, or bytes of which any but zero is true.
#[derive(FromPyObject)]
pub enum Flags<'py> {
    Booleans(PyReadonlyArray1<'py, bool>),
    Bytes(PyReadonlyArray1<'py, u8>),
}

impl Flags<'_> {
    pub fn values(&self) -> Vec<bool> {
        match self {
            Self::Booleans(flags) => flags.as_array().iter().copied().collect(),
            Self::Bytes(flags) => flags.as_array().iter().map(|&byte| byte != 0).collect(),
        }
    }
}

pub fn array<'py, T: Element, D: Dimension, const N: usize>(
    py: Python<'py>,
    values: Vec<T>,
    shape: [usize; N],
) -> PyResult<Bound<'py, PyArray<T, D>>>
where
    [usize; N]: IntoDimension<Dim = D>,
{
    values.into_pyarray(py).reshape(shape)
}

pub fn flat<'a, T: Element, D: Dimension>(name: &str, array: &'a PyReadonlyArray<'_, T, D>) -> PyResult<&'a [T]> {
    array
        .as_slice()
        .map_err(|_| PyValueError::new_err(format!("{name} is not C-contiguous; pass numpy.ascontiguousarray of it.")))
}

pub fn shape<T: Element, D: Dimension, const N: usize>(
    name: &str,
    array: &PyReadonlyArray<'_, T, D>,
    expected: [Option<usize>; N],
) -> PyResult<[usize; N]> {
    let got = array.shape();
    let fits = got.len() == N && got.iter().zip(expected).all(|(g, e)| e.is_none_or(|e| *g == e));
    match <[usize; N]>::try_from(got) {
        Ok(sizes) if fits => Ok(sizes),
        _ => {
            let wanted = expected.map(|e| e.map_or("any".to_owned(), |e| e.to_string())).join(", ");
            Err(PyValueError::new_err(format!("{name} has shape {got:?}; expected [{wanted}].")))
        }
    }
}

pub fn refused(error: raster::Error) -> PyErr {
    PyValueError::new_err(error.to_string())
}
