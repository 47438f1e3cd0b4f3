//! Python face of animated SVG and of gradients that go along with their paths.

use geometry::gradient::follow_path;
use geometry::point::Point;
use geometry::smil::{Fill, Options, Picture, RiggedMotion, write};
use numpy::{PyReadonlyArray1, PyReadonlyArray2, PyReadonlyArray3};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::geometry::{Points, PyRig, points_of, rows};

/// An animated SVG of a rigged scene.
///
/// `layers` are the numbers of back and fore paths, `openings` [n_local] the opening of each local path, `fills` [n, 13] as
/// in `Fill::from_flat`, `axes` [2n, 2] both gradient ends of every path at rest, `vertices` [frames, V, 2] evenly spaced
/// over `duration` seconds. Raises `ValueError` when they do not fit together.
#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "flat arrays only cross the border")]
fn animated_svg(
    py: Python,
    rig: &PyRig,
    size: (f64, f64),
    canvas: [u8; 3],
    layers: (usize, usize),
    openings: Vec<usize>,
    fills: PyReadonlyArray2<f64>,
    axes: PyReadonlyArray2<f64>,
    vertices: PyReadonlyArray3<f64>,
    duration: f64,
    tolerance: f64,
    looped: bool,
    title: &str,
    description: &str,
) -> PyResult<String> {
    let picture = Picture {
        width: size.0,
        height: size.1,
        canvas,
        n_back: layers.0,
        n_fore: layers.1,
        fills: Fill::from_flat(&fills.as_array().iter().copied().collect::<Vec<_>>()),
        openings,
    };
    let axes = points_of(&axes)?;
    let flat: Vec<f64> = vertices.as_array().iter().copied().collect();
    let options = Options { duration, tolerance, looped, title, description };
    let rig = &rig.rig;
    py.detach(|| {
        let vertices = geometry::point::from_flat(&flat);
        let motion = RiggedMotion::new(rig, &vertices, &axes).filter(|_| picture.is_whole() && options.is_sound());
        motion.map(|motion| write(&picture, &motion, &options))
    })
    .ok_or_else(|| PyValueError::new_err("picture, gradient ends, frames and options do not fit the rig"))
}

/// Ends [2k, 2] of the gradients of the k `changed` paths of a frame, from their rest ends `axes` [2n, 2].
#[pyfunction]
fn follow_gradients<'py>(
    py: Python<'py>,
    rig: &PyRig,
    changed: PyReadonlyArray1<usize>,
    starts: PyReadonlyArray1<usize>,
    points: PyReadonlyArray2<f64>,
    axes: PyReadonlyArray2<f64>,
) -> PyResult<Points<'py>> {
    let (points, axes) = (points_of(&points)?, points_of(&axes)?);
    let (changed, starts) = (changed.as_array(), starts.as_array());
    let ends: Option<Vec<[Point; 2]>> = changed
        .iter()
        .enumerate()
        .map(|(k, &path)| {
            let warped = points.get(*starts.get(k)?..*starts.get(k + 1)?)?;
            Some(follow_path([*axes.get(2 * path)?, *axes.get(2 * path + 1)?], rig.rig.paths().rest_path(path), warped))
        })
        .collect();
    let ends = ends.ok_or_else(|| PyValueError::new_err("frame and gradient ends do not fit together"))?;
    rows(py, &ends.concat())
}

pub fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_function(wrap_pyfunction!(animated_svg, module)?)?;
    module.add_function(wrap_pyfunction!(follow_gradients, module)?)
}
