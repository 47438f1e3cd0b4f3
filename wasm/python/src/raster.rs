//! Python face of the `raster` crate.

use numpy::{Element, PyArrayMethods, PyUntypedArrayMethods};
use numpy::{
    IntoPyArray, PyArray, PyArray1, PyArray3, PyReadonlyArray1, PyReadonlyArray2, PyReadonlyArray3,
};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use raster::{Checkpoint, Frame, Gradients, Objective, Paths};

pub fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_function(wrap_pyfunction!(rasterize, module)?)?;
    module.add_function(wrap_pyfunction!(loss_and_gradients, module)?)?;
    module.add_function(wrap_pyfunction!(gradients, module)?)?;
    module.add_function(wrap_pyfunction!(coverage, module)?)?;
    module.add_function(wrap_pyfunction!(overlap, module)?)
}

/// Arrays of a call as Python gives them.
struct Scene<'py> {
    points: PyReadonlyArray3<'py, f32>,
    stops: PyReadonlyArray3<'py, f32>,
    axis: PyReadonlyArray2<'py, f32>,
    gradient: Vec<bool>,
    clip: PyReadonlyArray1<'py, i32>,
    clips: PyReadonlyArray3<'py, f32>,
    canvas: PyReadonlyArray1<'py, f32>,
    width: usize,
    height: usize,
    subrows: usize,
    quantise: bool,
}

impl Scene<'_> {
    fn paths(&self) -> PyResult<Paths<'_>> {
        let [n, controls, _] = shape("points", &self.points, [None, None, Some(2)])?;
        if controls == 0 || controls % 3 != 0 {
            return Err(PyValueError::new_err(format!(
                "points has {controls} control points a path; the count must be a positive multiple of 3."
            )));
        }
        shape("stops", &self.stops, [Some(n), Some(2), Some(4)])?;
        shape("axis", &self.axis, [Some(n), Some(4)])?;
        shape("clip", &self.clip, [Some(n)])?;
        if self.gradient.len() != n {
            return Err(PyValueError::new_err(format!(
                "gradient has {} values; expected {n}.",
                self.gradient.len()
            )));
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

    fn frame(&self) -> PyResult<Frame<'_>> {
        let (width, height) = (self.width, self.height);
        let [masks, ..] = shape("clips", &self.clips, [None, None, None])?;
        if masks > 0 {
            shape("clips", &self.clips, [None, Some(height), Some(width)])?;
        }
        shape("canvas", &self.canvas, [Some(3)])?;
        let c = flat("canvas", &self.canvas)?;
        let clips = flat("clips", &self.clips)?;
        Ok(Frame {
            width,
            height,
            canvas: [c[0], c[1], c[2]],
            clips,
            subrows: self.subrows,
            quantise: self.quantise,
        })
    }
}

/// Paint paths over a canvas: f32 `[H, W, 3]`.
#[pyfunction]
#[pyo3(signature = (points, stops, axis, gradient, clip, clips, canvas, width, height, subrows=1, threads=0, quantise=false))]
#[allow(clippy::too_many_arguments)] // one flat array each: the border's rule
fn rasterize<'py>(
    py: Python<'py>,
    points: PyReadonlyArray3<'py, f32>,
    stops: PyReadonlyArray3<'py, f32>,
    axis: PyReadonlyArray2<'py, f32>,
    gradient: Flags<'py>,
    clip: PyReadonlyArray1<'py, i32>,
    clips: PyReadonlyArray3<'py, f32>,
    canvas: PyReadonlyArray1<'py, f32>,
    width: usize,
    height: usize,
    subrows: usize,
    threads: usize,
    quantise: bool,
) -> PyResult<Bound<'py, PyArray3<f32>>> {
    let gradient = gradient.values();
    let scene = Scene {
        points,
        stops,
        axis,
        gradient,
        clip,
        clips,
        canvas,
        width,
        height,
        subrows,
        quantise,
    };
    let (paths, frame) = (scene.paths()?, scene.frame()?);
    let image = py
        .detach(|| raster::rasterize(&paths, &frame, threads))
        .map_err(refused)?;
    array(py, image, [height, width, 3])
}

type CheckpointArrays<'py> = (
    usize,
    PyReadonlyArray3<'py, f32>,
    PyReadonlyArray2<'py, f32>,
);
type GradientArrays<'py> = (
    Bound<'py, PyArray1<f64>>,
    Bound<'py, PyArray3<f32>>,
    Bound<'py, PyArray3<f32>>,
    Bound<'py, PyArray3<f32>>,
    Bound<'py, PyArray<f32, numpy::Ix2>>,
    Option<Bound<'py, PyArray1<f64>>>,
);

/// Losses of checkpoints `(paths below, target, weight)`, the picture, and gradients of the summed loss.
#[pyfunction]
#[pyo3(signature = (points, stops, axis, gradient, clip, clips, canvas, checkpoints, subrows=1, threads=0, importance=false, quantise=false))]
#[allow(clippy::too_many_arguments)] // one flat array each: the border's rule
fn loss_and_gradients<'py>(
    py: Python<'py>,
    points: PyReadonlyArray3<'py, f32>,
    stops: PyReadonlyArray3<'py, f32>,
    axis: PyReadonlyArray2<'py, f32>,
    gradient: Flags<'py>,
    clip: PyReadonlyArray1<'py, i32>,
    clips: PyReadonlyArray3<'py, f32>,
    canvas: PyReadonlyArray1<'py, f32>,
    checkpoints: Vec<CheckpointArrays<'py>>,
    subrows: usize,
    threads: usize,
    importance: bool,
    quantise: bool,
) -> PyResult<GradientArrays<'py>> {
    let Some((_, target, _)) = checkpoints.first() else {
        return Err(PyValueError::new_err(
            "checkpoints is empty; at least one is needed.",
        ));
    };
    let [height, width, _] = shape("target", target, [None, None, Some(3)])?;
    let gradient = gradient.values();
    let scene = Scene {
        points,
        stops,
        axis,
        gradient,
        clip,
        clips,
        canvas,
        width,
        height,
        subrows,
        quantise,
    };
    let (paths, frame) = (scene.paths()?, scene.frame()?);
    let mut targets = Vec::with_capacity(checkpoints.len());
    for (below, target, weight) in &checkpoints {
        shape("target", target, [Some(height), Some(width), Some(3)])?;
        shape("weight", weight, [Some(height), Some(width)])?;
        targets.push(Checkpoint {
            below: *below,
            target: flat("target", target)?,
            weight: flat("weight", weight)?,
        });
    }
    let objective = Objective::Checkpoints(&targets);
    let found = py
        .detach(|| raster::differentiate(&paths, &frame, &objective, importance, threads))
        .map_err(refused)?;
    arrays(py, found, &paths, &frame, importance)
}

/// Gradients of any loss, given its gradient with respect to the picture, `grad_image` f32 `[H, W, 3]`.
#[pyfunction]
#[pyo3(signature = (points, stops, axis, gradient, clip, clips, canvas, grad_image, subrows=1, threads=0, quantise=false))]
#[allow(clippy::too_many_arguments)] // one flat array each: the border's rule
fn gradients<'py>(
    py: Python<'py>,
    points: PyReadonlyArray3<'py, f32>,
    stops: PyReadonlyArray3<'py, f32>,
    axis: PyReadonlyArray2<'py, f32>,
    gradient: Flags<'py>,
    clip: PyReadonlyArray1<'py, i32>,
    clips: PyReadonlyArray3<'py, f32>,
    canvas: PyReadonlyArray1<'py, f32>,
    grad_image: PyReadonlyArray3<'py, f32>,
    subrows: usize,
    threads: usize,
    quantise: bool,
) -> PyResult<GradientArrays<'py>> {
    let [height, width, _] = shape("grad_image", &grad_image, [None, None, Some(3)])?;
    let gradient = gradient.values();
    let scene = Scene {
        points,
        stops,
        axis,
        gradient,
        clip,
        clips,
        canvas,
        width,
        height,
        subrows,
        quantise,
    };
    let (paths, frame) = (scene.paths()?, scene.frame()?);
    let objective = Objective::Upstream(flat("grad_image", &grad_image)?);
    let found = py
        .detach(|| raster::differentiate(&paths, &frame, &objective, false, threads))
        .map_err(refused)?;
    arrays(py, found, &paths, &frame, false)
}

/// Coverage of one closed path, control points f32 `[3S, 2]`: f32 `[H, W]`.
#[pyfunction]
fn coverage<'py>(
    py: Python<'py>,
    points: PyReadonlyArray2<'py, f32>,
    width: usize,
    height: usize,
) -> PyResult<Bound<'py, PyArray<f32, numpy::Ix2>>> {
    shape("points", &points, [None, Some(2)])?;
    let ring = flat("points", &points)?;
    let mask = py
        .detach(|| raster::coverage(ring, width, height))
        .map_err(refused)?;
    array(py, mask, [height, width])
}

/// Areas of each path in pixels, f64 `[n, 3]`: covered at all, wound around more than once, wound against its main direction.
#[pyfunction]
#[pyo3(signature = (points, width, height, threads=0))]
fn overlap<'py>(
    py: Python<'py>,
    points: PyReadonlyArray3<'py, f32>,
    width: usize,
    height: usize,
    threads: usize,
) -> PyResult<Bound<'py, PyArray<f64, numpy::Ix2>>> {
    let [n, controls, _] = shape("points", &points, [None, None, Some(2)])?;
    let ring = flat("points", &points)?;
    let (stops, axis, gradient, clip) = (
        vec![0.0; 8 * n],
        vec![0.0; 4 * n],
        vec![false; n],
        vec![-1; n],
    );
    let paths = Paths {
        segments: controls / 3,
        points: ring,
        stops: &stops,
        axis: &axis,
        gradient: &gradient,
        clip: &clip,
    };
    let frame = Frame {
        width,
        height,
        canvas: [0.0; 3],
        clips: &[],
        subrows: 4,
        quantise: false,
    };
    let found = py
        .detach(|| raster::overlaps(&paths, &frame, threads))
        .map_err(refused)?;
    let areas = found
        .iter()
        .flat_map(|o| [o.covered, o.folded, o.reversed])
        .collect();
    array(py, areas, [n, 3])
}

/// A boolean array, or bytes of which any but zero is true.
#[derive(FromPyObject)]
enum Flags<'py> {
    Booleans(PyReadonlyArray1<'py, bool>),
    Bytes(PyReadonlyArray1<'py, u8>),
}

impl Flags<'_> {
    fn values(&self) -> Vec<bool> {
        match self {
            Self::Booleans(flags) => flags.as_array().iter().copied().collect(),
            Self::Bytes(flags) => flags.as_array().iter().map(|&byte| byte != 0).collect(),
        }
    }
}

fn arrays<'py>(
    py: Python<'py>,
    found: Gradients,
    paths: &Paths<'_>,
    frame: &Frame<'_>,
    importance: bool,
) -> PyResult<GradientArrays<'py>> {
    let n = paths.len();
    Ok((
        found.losses.into_pyarray(py),
        array(py, found.image, [frame.height, frame.width, 3])?,
        array(py, found.points, [n, 3 * paths.segments, 2])?,
        array(py, found.stops, [n, 2, 4])?,
        array(py, found.axis, [n, 4])?,
        importance.then(|| found.importance.into_pyarray(py)),
    ))
}

fn array<'py, T: Element, D: numpy::ndarray::Dimension, const N: usize>(
    py: Python<'py>,
    values: Vec<T>,
    shape: [usize; N],
) -> PyResult<Bound<'py, PyArray<T, D>>>
where
    [usize; N]: numpy::ndarray::IntoDimension<Dim = D>,
{
    values.into_pyarray(py).reshape(shape)
}

fn flat<'a, T: Element, D: numpy::ndarray::Dimension>(
    name: &str,
    array: &'a numpy::PyReadonlyArray<'_, T, D>,
) -> PyResult<&'a [T]> {
    array.as_slice().map_err(|_| {
        PyValueError::new_err(format!(
            "{name} is not C-contiguous; pass numpy.ascontiguousarray of it."
        ))
    })
}

fn shape<T: Element, D: numpy::ndarray::Dimension, const N: usize>(
    name: &str,
    array: &numpy::PyReadonlyArray<'_, T, D>,
    expected: [Option<usize>; N],
) -> PyResult<[usize; N]> {
    let got = array.shape();
    let fits = got.len() == N
        && got
            .iter()
            .zip(expected)
            .all(|(g, e)| e.is_none_or(|e| *g == e));
    match <[usize; N]>::try_from(got) {
        Ok(sizes) if fits => Ok(sizes),
        _ => {
            let wanted = expected
                .map(|e| e.map_or("any".to_owned(), |e| e.to_string()))
                .join(", ");
            Err(PyValueError::new_err(format!(
                "{name} has shape {got:?}; expected [{wanted}]."
            )))
        }
    }
}

fn refused(error: raster::Error) -> PyErr {
    PyValueError::new_err(error.to_string())
}
