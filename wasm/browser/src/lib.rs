//! Border between the browser and `geometry`: flat arrays in, flat arrays and one string buffer out.

use geometry::bound::Options;
use geometry::error::RigError;
use geometry::face::Iris;
use geometry::opening::{N_LANDMARKS, Opening};
use geometry::path_string::path_string;
use geometry::point::{Point, from_flat, to_flat};
use geometry::pose::channel::{CHANNELS, Pose};
use geometry::rig::{RestFace, Rig};
use geometry::scene::{Layer, SceneGeometry};
use wasm_bindgen::prelude::*;

mod frame;
mod smil;

/// Names of the articulators, in the order `Rig.vertices` takes them.
#[wasm_bindgen(js_name = channelNames)]
#[must_use]
pub fn channel_names() -> Vec<String> {
    CHANNELS.iter().map(|(name, _, _)| (*name).to_owned()).collect()
}

/// Least and greatest value of each articulator, `least, greatest, …`.
#[wasm_bindgen(js_name = channelRanges)]
#[must_use]
pub fn channel_ranges() -> Vec<f64> {
    CHANNELS.iter().flat_map(|&(_, least, greatest)| [least, greatest]).collect()
}

/// SVG path data of a closed cubic chain `x, y, …`.
#[wasm_bindgen(js_name = pathData)]
#[must_use]
pub fn path_data(points: &[f64]) -> String {
    path_string(&from_flat(points))
}

/// Landmarks and irises for five pins `x, y, …`: 136 numbers, then x, y, radius twice; empty when the pins coincide.
#[wasm_bindgen(js_name = fitPins)]
#[must_use]
pub fn fit_pins(pins: &[f64]) -> Vec<f64> {
    let Some((landmarks, irises)) = from_flat(pins).try_into().ok().and_then(|pins| geometry::fit::fit_pins(&pins))
    else {
        return Vec::new();
    };
    let irises = irises.into_iter().flat_map(|iris| [iris.centre.x, iris.centre.y, iris.radius]);
    to_flat(&landmarks).into_iter().chain(irises).collect()
}

#[wasm_bindgen(js_name = Rig)]
pub struct BrowserRig {
    rig: Rig,
}

#[wasm_bindgen(js_class = Rig)]
impl BrowserRig {
    /// Builds a rig. `points` are all control points; `layers` are 0 back, 1 fore, 2 + part; `irises` are x, y, radius
    /// twice or empty; `depth` has 68 numbers or none.
    ///
    /// # Errors
    /// A `RigError` with the core's code and message.
    #[wasm_bindgen(constructor)]
    #[expect(clippy::too_many_arguments, reason = "flat arrays only cross the border")]
    pub fn new(
        width: f64,
        height: f64,
        points: &[f64],
        segments: &[u32],
        layers: &[u8],
        landmarks: &[f64],
        irises: &[f64],
        depth: &[f64],
        split: bool,
        smooth: bool,
    ) -> Result<BrowserRig, JsError> {
        let layers: Vec<Layer> =
            layers.iter().map(|&number| Layer::from_number(number)).collect::<Result<_, _>>().map_err(raise)?;
        let segments: Vec<usize> = segments.iter().map(|&n| n as usize).collect();
        let points = from_flat(points);
        let scene = SceneGeometry { width, height, points: &points, segments: &segments, layers: &layers };
        let rest = RestFace {
            landmarks: landmark_points(landmarks)?,
            irises: given::<6>("iris numbers", irises)?.map(iris_pair),
            depth: given("depths", depth)?,
        };
        let rig = Rig::build(&scene, &rest, Options { split, smooth }).map_err(raise)?;
        Ok(Self { rig })
    }

    /// Vertices at rest, `x, y, …`; the first 68 are the landmarks, then two irises.
    #[wasm_bindgen(getter, js_name = restVertices)]
    #[must_use]
    pub fn rest_vertices(&self) -> Vec<f64> {
        to_flat(self.rig.rest_vertices())
    }

    /// Vertex indices, three a triangle.
    #[wasm_bindgen(getter)]
    #[must_use]
    pub fn triangles(&self) -> Vec<u32> {
        self.rig.mesh().triangles.iter().flat_map(|triangle| triangle.vertices.map(|vertex| vertex as u32)).collect()
    }

    #[wasm_bindgen(getter, js_name = pathCount)]
    #[must_use]
    pub fn path_count(&self) -> usize {
        self.rig.paths().n_paths()
    }

    /// Control points of one path at rest, split as in every frame; empty when there is no such path.
    #[wasm_bindgen(js_name = restPath)]
    #[must_use]
    pub fn rest_path(&self, path: usize) -> Vec<f64> {
        to_flat(self.rig.paths().rest_path(path))
    }

    /// Vertices of a pose; empty `offsets` means none.
    ///
    /// # Errors
    /// A `RigError` for lengths that are wrong and numbers that are not finite.
    pub fn vertices(&self, articulators: &[f64], offsets: &[f64]) -> Result<PosedVertices, JsError> {
        let pose = Pose::from_flat(articulators, offsets).map_err(raise)?;
        let (vertices, limit) = self.rig.vertices(&pose);
        Ok(PosedVertices {
            positions: to_flat(&vertices),
            scale: limit.scale,
            triangles: limit.triangles.into_iter().map(|triangle| triangle as u32).collect(),
        })
    }

    /// Outline of opening 0 (left eye), 1 (right eye) or 2 (mouth) for posed vertices; empty when there is none.
    #[must_use]
    pub fn opening(&self, opening: usize, vertices: &[f64]) -> Vec<f64> {
        let vertices = from_flat(vertices);
        match Opening::ALL.get(opening) {
            Some(opening) if vertices.len() >= N_LANDMARKS => to_flat(&opening.outline(&vertices)),
            _ => Vec::new(),
        }
    }
}

/// Vertices of a pose, the kept share of its motion (1 when nothing limits it), and the triangles that would turn over
/// first.
#[wasm_bindgen(getter_with_clone)]
pub struct PosedVertices {
    #[wasm_bindgen(readonly)]
    pub positions: Vec<f64>,
    #[wasm_bindgen(readonly)]
    pub scale: f64,
    #[wasm_bindgen(readonly)]
    pub triangles: Vec<u32>,
}

fn raise(error: RigError) -> JsError {
    JsError::new(&format!("{}: {error}", error.code()))
}

fn landmark_points(flat: &[f64]) -> Result<[Point; N_LANDMARKS], JsError> {
    from_flat(flat).try_into().map_err(|points: Vec<Point>| {
        JsError::new(&format!("bad_landmarks: {} landmarks given, {N_LANDMARKS} wanted", points.len()))
    })
}

/// The `N` numbers of an optional list; an empty one is none.
fn given<const N: usize>(what: &str, numbers: &[f64]) -> Result<Option<[f64; N]>, JsError> {
    if numbers.is_empty() {
        return Ok(None);
    }
    let misfit = |_| JsError::new(&format!("bad_landmarks: {} {what} given, {N} or none wanted", numbers.len()));
    numbers.try_into().map(Some).map_err(misfit)
}

fn iris_pair([x0, y0, r0, x1, y1, r1]: [f64; 6]) -> [Iris; 2] {
    [Iris { centre: Point::new(x0, y0), radius: r0 }, Iris { centre: Point::new(x1, y1), radius: r1 }]
}
