//! Python face of the `geometry` crate.

use geometry::bound::{Frame, Options};
use geometry::error::RigError;
use geometry::face::Iris;
use geometry::opening::{self, N_LANDMARKS};
use geometry::path_string::path_string;
use geometry::point::{Point, to_flat};
use geometry::pose::channel::{CHANNELS, Pose};
use geometry::rig::{RestFace, Rig};
use geometry::scene::{Layer, SceneGeometry};
use numpy::{IntoPyArray, PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray2};
use pyo3::exceptions::{PyIndexError, PyValueError};
use pyo3::prelude::*;

pub type Points<'py> = Bound<'py, PyArray2<f64>>;
type Indices<'py> = Bound<'py, PyArray1<usize>>;
type Outline<'py> = (&'static str, Points<'py>, bool);

/// Outlines of the eye and mouth openings of 68 landmarks at rest: `(name, points[3S, 2], closed)`.
#[pyfunction]
fn opening_outlines<'py>(py: Python<'py>, landmarks: PyReadonlyArray2<'py, f64>) -> PyResult<Vec<Outline<'py>>> {
    opening::rest_outlines(&landmark_points(&landmarks)?)
        .into_iter()
        .map(|outline| Ok((outline.opening.name(), rows(py, &outline.points)?, outline.closed)))
        .collect()
}

/// Names and ranges of the articulators, in the order `Rig.vertices` takes them.
#[pyfunction]
fn channels() -> Vec<(&'static str, f64, f64)> {
    CHANNELS.to_vec()
}

/// SVG path data of a closed cubic chain.
#[pyfunction]
fn path_data(points: PyReadonlyArray2<f64>) -> PyResult<String> {
    Ok(path_string(&points_of(&points)?))
}

type Fit<'py> = (Points<'py>, [[f64; 3]; 2]);

/// Landmarks [68, 2] and irises (x, y, radius) for five pins [5, 2]; None when the pins coincide.
#[pyfunction]
fn fit_pins<'py>(py: Python<'py>, pins: PyReadonlyArray2<'py, f64>) -> PyResult<Option<Fit<'py>>> {
    let pins = points_of(&pins)?
        .try_into()
        .map_err(|pins: Vec<Point>| PyValueError::new_err(format!("expected 5 pins, got {}", pins.len())))?;
    let Some((landmarks, irises)) = geometry::fit::fit_pins(&pins) else {
        return Ok(None);
    };
    let irises = irises.map(|iris| [iris.centre.x, iris.centre.y, iris.radius]);
    Ok(Some((rows(py, &landmarks)?, irises)))
}

#[pyclass(name = "Rig", frozen, module = "vectortalker_core")]
pub struct PyRig {
    pub rig: Rig,
}

#[pymethods]
impl PyRig {
    #[new]
    #[pyo3(signature = (size, points, segments, layers, landmarks, irises=None, depth=None, split=true, smooth=true))]
    #[expect(clippy::too_many_arguments, reason = "flat arrays only cross the border")]
    fn new(
        size: (f64, f64),
        points: PyReadonlyArray2<f64>,
        segments: Vec<usize>,
        layers: Vec<u8>,
        landmarks: PyReadonlyArray2<f64>,
        irises: Option<[[f64; 3]; 2]>,
        depth: Option<Vec<f64>>,
        split: bool,
        smooth: bool,
    ) -> PyResult<Self> {
        let layers: Vec<Layer> = layers.into_iter().map(Layer::from_number).collect::<Result<_, _>>().map_err(raise)?;
        let points = points_of(&points)?;
        let scene =
            SceneGeometry { width: size.0, height: size.1, points: &points, segments: &segments, layers: &layers };
        let rest = RestFace {
            landmarks: landmark_points(&landmarks)?,
            irises: irises.map(|pair| pair.map(|[x, y, radius]| Iris { centre: Point::new(x, y), radius })),
            depth: depth.map(depths).transpose()?,
        };
        let rig = Rig::build(&scene, &rest, Options { split, smooth }).map_err(raise)?;
        Ok(Self { rig })
    }

    #[getter]
    fn rest_vertices<'py>(&self, py: Python<'py>) -> PyResult<Points<'py>> {
        rows(py, self.rig.rest_vertices())
    }

    /// Vertex indices of the triangles, [T, 3].
    #[getter]
    fn triangles<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<usize>>> {
        let triangles = &self.rig.mesh().triangles;
        let flat: Vec<usize> = triangles.iter().flat_map(|triangle| triangle.vertices).collect();
        flat.into_pyarray(py).reshape([triangles.len(), 3])
    }

    #[getter]
    fn n_paths(&self) -> usize {
        self.rig.paths().n_paths()
    }

    /// Control points of one path at rest, split as in every frame.
    fn rest_path<'py>(&self, py: Python<'py>, path: usize) -> PyResult<Points<'py>> {
        if path >= self.n_paths() {
            return Err(PyIndexError::new_err(format!("path {path} of {}", self.n_paths())));
        }
        rows(py, self.rig.paths().rest_path(path))
    }

    /// Vertex positions of a pose, the kept share of its motion, and the triangles that limit it.
    #[pyo3(signature = (articulators, offsets=None))]
    fn vertices<'py>(
        &self,
        py: Python<'py>,
        articulators: Vec<f64>,
        offsets: Option<PyReadonlyArray2<'py, f64>>,
    ) -> PyResult<(Points<'py>, f64, Vec<usize>)> {
        let offsets = offsets.as_ref().map(points_of).transpose()?.unwrap_or_default();
        let pose = Pose::from_flat(&articulators, &to_flat(&offsets)).map_err(raise)?;
        let (vertices, limit) = self.rig.vertices(&pose);
        Ok((rows(py, &vertices)?, limit.scale, limit.triangles))
    }

    /// Control points of the paths that differ between `since` (rest when None) and `vertices`: indices of the changed
    /// paths, where the points of each begin and end, and the points.
    #[pyo3(signature = (vertices, since=None))]
    fn frame<'py>(
        &self,
        py: Python<'py>,
        vertices: PyReadonlyArray2<'py, f64>,
        since: Option<PyReadonlyArray2<'py, f64>>,
    ) -> PyResult<(Indices<'py>, Indices<'py>, Points<'py>)> {
        let vertices = points_of(&vertices)?;
        let since = since.as_ref().map(points_of).transpose()?;
        let since = since.as_deref().unwrap_or(self.rig.rest_vertices());
        let Frame { changed, starts, points } = self.rig.frame(&vertices, since).map_err(raise)?;
        Ok((changed.into_pyarray(py), starts.into_pyarray(py), rows(py, &points)?))
    }

    /// Outlines of left eye, right eye and mouth for posed vertices.
    fn openings<'py>(&self, py: Python<'py>, vertices: PyReadonlyArray2<'py, f64>) -> PyResult<Vec<Points<'py>>> {
        let vertices = points_of(&vertices)?;
        if vertices.len() < N_LANDMARKS {
            return Err(PyValueError::new_err(format!("{} vertices given", vertices.len())));
        }
        self.rig.openings(&vertices).iter().map(|outline| rows(py, outline)).collect()
    }
}

pub fn raise(error: RigError) -> PyErr {
    PyValueError::new_err(error.to_string())
}

pub fn points_of(array: &PyReadonlyArray2<f64>) -> PyResult<Vec<Point>> {
    let view = array.as_array();
    if view.ncols() != 2 {
        let columns = view.ncols();
        return Err(PyValueError::new_err(format!("expected (x, y) rows, got {columns} columns")));
    }
    Ok(view.rows().into_iter().map(|row| Point::new(row[0], row[1])).collect())
}

fn landmark_points(array: &PyReadonlyArray2<f64>) -> PyResult<[Point; N_LANDMARKS]> {
    points_of(array)?.try_into().map_err(|points: Vec<Point>| {
        PyValueError::new_err(format!("expected {N_LANDMARKS} landmarks, got {}", points.len()))
    })
}

fn depths(depth: Vec<f64>) -> PyResult<[f64; N_LANDMARKS]> {
    depth
        .try_into()
        .map_err(|depth: Vec<f64>| PyValueError::new_err(format!("expected {N_LANDMARKS} depths, got {}", depth.len())))
}

pub fn rows<'py>(py: Python<'py>, points: &[Point]) -> PyResult<Points<'py>> {
    to_flat(points).into_pyarray(py).reshape([points.len(), 2])
}

pub fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<PyRig>()?;
    module.add_function(wrap_pyfunction!(opening_outlines, module)?)?;
    module.add_function(wrap_pyfunction!(channels, module)?)?;
    module.add_function(wrap_pyfunction!(fit_pins, module)?)?;
    module.add_function(wrap_pyfunction!(path_data, module)?)
}
