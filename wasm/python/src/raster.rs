//! Python face of the `raster` crate.

mod adam;
mod arrays;
mod residual;

use arrays::{Flags, Scene, array, flat, refused, shape};
use numpy::{
    IntoPyArray, Ix2, PyArray, PyArray1, PyArray3, PyArray4, PyReadonlyArray1, PyReadonlyArray2, PyReadonlyArray3,
};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use raster::{Checkpoint, Extras, Frame, Gradients, Objective, Paths, Sample, Target};

pub fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<PyTarget>()?;
    module.add_function(wrap_pyfunction!(rasterize, module)?)?;
    module.add_function(wrap_pyfunction!(preview, module)?)?;
    module.add_function(wrap_pyfunction!(loss_and_gradients, module)?)?;
    module.add_function(wrap_pyfunction!(gradients, module)?)?;
    module.add_function(wrap_pyfunction!(adam::adam_step, module)?)?;
    module.add_function(wrap_pyfunction!(residual::coherent_energy, module)?)?;
    module.add_function(wrap_pyfunction!(residual::contour, module)?)?;
    module.add_function(wrap_pyfunction!(rasterize_stack, module)?)?;
    module.add_function(wrap_pyfunction!(coverage, module)?)?;
    module.add_function(wrap_pyfunction!(overlap, module)?)
}

/// Paint paths over a canvas: f32 `[H, W, 3]`.
#[pyfunction]
#[pyo3(signature = (points, stops, axis, gradient, clip, clips, canvas, width, height, subrows=1, threads=0, quantise=false, flatness=raster::FLATNESS))]
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
    flatness: f32,
) -> PyResult<Bound<'py, PyArray3<f32>>> {
    let gradient = gradient.values();
    let scene =
        Scene { points, stops, axis, gradient, clip, clips, canvas, width, height, subrows, flatness, quantise };
    let (paths, frame) = (scene.paths()?, scene.frame()?);
    let image = py.detach(|| raster::rasterize(&paths, &frame, threads)).map_err(refused)?;
    array(py, image, [height, width, 3])
}

/// Paint the lowest paths, as many as each of the ascending `heights` says: f32 `[len(heights), H, W, 3]`.
#[pyfunction]
#[pyo3(signature = (points, stops, axis, gradient, clip, clips, canvas, width, height, heights, subrows=1, threads=0, flatness=raster::FLATNESS))]
#[allow(clippy::too_many_arguments)] // one flat array each: the border's rule
fn rasterize_stack<'py>(
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
    heights: Vec<usize>,
    subrows: usize,
    threads: usize,
    flatness: f32,
) -> PyResult<Bound<'py, PyArray4<f32>>> {
    let (gradient, quantise) = (gradient.values(), false);
    let scene =
        Scene { points, stops, axis, gradient, clip, clips, canvas, width, height, subrows, flatness, quantise };
    let (paths, frame) = (scene.paths()?, scene.frame()?);
    let images = py.detach(|| raster::rasterize_stack(&paths, &frame, &heights, threads)).map_err(refused)?;
    array(py, images, [heights.len(), height, width, 3])
}

/// Paint paths over a canvas as resvg does, sampled edges and 8-bit blends included: f32 `[H, W, 3]`.
#[pyfunction]
#[pyo3(signature = (points, stops, axis, gradient, clip, clips, canvas, width, height, threads=0))]
#[allow(clippy::too_many_arguments)] // one flat array each: the border's rule
fn preview<'py>(
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
    threads: usize,
) -> PyResult<Bound<'py, PyArray3<f32>>> {
    let (gradient, subrows, flatness, quantise) = (gradient.values(), 4, raster::FLATNESS, true);
    let scene =
        Scene { points, stops, axis, gradient, clip, clips, canvas, width, height, subrows, flatness, quantise };
    let (paths, frame) = (scene.paths()?, scene.frame()?);
    let image = py.detach(|| raster::preview(&paths, &frame, threads)).map_err(refused)?;
    array(py, image, [height, width, 3])
}

/// A target picture and its weights, laid out once for all passes that compare with it.
#[pyclass(name = "Target", frozen)]
struct PyTarget(Target);

#[pymethods]
impl PyTarget {
    #[new]
    fn new(target: PyReadonlyArray3<'_, f32>, weight: PyReadonlyArray2<'_, f32>) -> PyResult<Self> {
        let [height, width, _] = shape("target", &target, [None, None, Some(3)])?;
        shape("weight", &weight, [Some(height), Some(width)])?;
        let target = Target::new(flat("target", &target)?, flat("weight", &weight)?, width, height);
        Ok(Self(target.map_err(refused)?))
    }
}

type GradientArrays<'py> = (
    Bound<'py, PyArray1<f64>>,
    Bound<'py, PyArray3<f32>>,
    Bound<'py, PyArray3<f32>>,
    Bound<'py, PyArray3<f32>>,
    Bound<'py, PyArray<f32, Ix2>>,
    Option<Bound<'py, PyArray1<f64>>>,
);

/// Losses of checkpoints `(paths below, target, weight)`, the picture (if asked for), and gradients of the summed loss.
#[pyfunction]
#[pyo3(signature = (points, stops, axis, gradient, clip, clips, canvas, checkpoints, subrows=1, threads=0, importance=false, quantise=false, picture=true, flatness=raster::FLATNESS, bands=(1, 0)))]
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
    checkpoints: Vec<(usize, PyRef<'py, PyTarget>)>,
    subrows: usize,
    threads: usize,
    importance: bool,
    quantise: bool,
    picture: bool,
    flatness: f32,
    bands: (usize, usize),
) -> PyResult<GradientArrays<'py>> {
    let Some((_, target)) = checkpoints.first() else {
        return Err(PyValueError::new_err("checkpoints is empty; at least one is needed."));
    };
    let (width, height) = (target.0.width, target.0.height);
    let gradient = gradient.values();
    let scene =
        Scene { points, stops, axis, gradient, clip, clips, canvas, width, height, subrows, flatness, quantise };
    let (paths, frame) = (scene.paths()?, scene.frame()?);
    let targets: Vec<_> =
        checkpoints.iter().map(|(below, target)| Checkpoint { below: *below, target: &target.0 }).collect();
    let objective = Objective::Checkpoints(&targets);
    let bands = Sample { every: bands.0, first: bands.1 };
    let extras = Extras { importance, picture, bands };
    let found = py.detach(|| raster::differentiate(&paths, &frame, &objective, extras, threads)).map_err(refused)?;
    arrays(py, found, &paths, &frame, extras)
}

/// Gradients of any loss, given its gradient with respect to the picture, `grad_image` f32 `[H, W, 3]`.
#[pyfunction]
#[pyo3(signature = (points, stops, axis, gradient, clip, clips, canvas, grad_image, subrows=1, threads=0, quantise=false, flatness=raster::FLATNESS))]
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
    flatness: f32,
) -> PyResult<GradientArrays<'py>> {
    let [height, width, _] = shape("grad_image", &grad_image, [None, None, Some(3)])?;
    let gradient = gradient.values();
    let scene =
        Scene { points, stops, axis, gradient, clip, clips, canvas, width, height, subrows, flatness, quantise };
    let (paths, frame) = (scene.paths()?, scene.frame()?);
    let objective = Objective::Upstream(flat("grad_image", &grad_image)?);
    let extras = Extras { picture: true, ..Extras::default() };
    let found = py.detach(|| raster::differentiate(&paths, &frame, &objective, extras, threads)).map_err(refused)?;
    arrays(py, found, &paths, &frame, extras)
}

/// Coverage of one closed path, control points f32 `[3S, 2]`: f32 `[H, W]`.
#[pyfunction]
fn coverage<'py>(
    py: Python<'py>,
    points: PyReadonlyArray2<'py, f32>,
    width: usize,
    height: usize,
) -> PyResult<Bound<'py, PyArray<f32, Ix2>>> {
    shape("points", &points, [None, Some(2)])?;
    let ring = flat("points", &points)?;
    let mask = py.detach(|| raster::coverage(ring, width, height)).map_err(refused)?;
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
) -> PyResult<Bound<'py, PyArray<f64, Ix2>>> {
    let [n, controls, _] = shape("points", &points, [None, None, Some(2)])?;
    let ring = flat("points", &points)?;
    let (stops, axis, gradient, clip) =
        (vec![0.0; 4 * raster::STOPS * n], vec![0.0; 4 * n], vec![false; n], vec![-1; n]);
    let paths =
        Paths { segments: controls / 3, points: ring, stops: &stops, axis: &axis, gradient: &gradient, clip: &clip };
    let frame =
        Frame { width, height, canvas: [0.0; 3], clips: &[], subrows: 4, flatness: raster::FLATNESS, quantise: false };
    let found = py.detach(|| raster::overlaps(&paths, &frame, threads)).map_err(refused)?;
    let areas = found.iter().flat_map(|o| [o.covered, o.folded, o.reversed]).collect();
    array(py, areas, [n, 3])
}

fn arrays<'py>(
    py: Python<'py>,
    found: Gradients,
    paths: &Paths<'_>,
    frame: &Frame<'_>,
    extras: Extras,
) -> PyResult<GradientArrays<'py>> {
    let n = paths.len();
    Ok((
        found.losses.into_pyarray(py),
        array(py, found.image, if extras.picture { [frame.height, frame.width, 3] } else { [0, 0, 3] })?,
        array(py, found.points, [n, 3 * paths.segments, 2])?,
        array(py, found.stops, [n, raster::STOPS, 4])?,
        array(py, found.axis, [n, 4])?,
        extras.importance.then(|| found.importance.into_pyarray(py)),
    ))
}
