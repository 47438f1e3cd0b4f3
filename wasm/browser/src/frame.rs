//! Browser face of frames: the paths that differ between two lists of vertices, as numbers or as path data.

use geometry::bound::Frame;
use geometry::gradient::follow_path;
use geometry::path_string::push_path;
use geometry::point::{Point, from_flat, to_flat};
use wasm_bindgen::prelude::*;

use crate::{BrowserRig, raise};

#[wasm_bindgen(js_class = Rig)]
impl BrowserRig {
    /// Control points of the paths that differ between the vertices `since` and `vertices`; `axes` are both gradient ends
    /// of every path at rest, four numbers each.
    ///
    /// # Errors
    /// A `RigError` when a list does not fit the rig.
    #[wasm_bindgen(js_name = framePoints)]
    pub fn frame_points(&self, vertices: &[f64], since: &[f64], axes: &[f64]) -> Result<FramePoints, JsError> {
        let (frame, axes) = self.frame(vertices, since, axes)?;
        let starts = frame.starts.iter().map(|&start| start as u32).collect();
        Ok(FramePoints { changed: numbers(&frame.changed), starts, points: to_flat(&frame.points), axes })
    }

    /// The same with path data for points.
    ///
    /// # Errors
    /// A `RigError` when a list does not fit the rig.
    #[wasm_bindgen(js_name = frameData)]
    pub fn frame_data(&self, vertices: &[f64], since: &[f64], axes: &[f64]) -> Result<FrameData, JsError> {
        let (frame, axes) = self.frame(vertices, since, axes)?;
        let mut text = Vec::new();
        let mut ends = Vec::with_capacity(frame.changed.len());
        for range in frame.starts.windows(2) {
            push_path(&frame.points[range[0]..range[1]], &mut text);
            ends.push(text.len() as u32);
        }
        let text = String::from_utf8(text).unwrap_or_default();
        Ok(FrameData { changed: numbers(&frame.changed), text, ends, axes })
    }

    /// A frame, and where the gradients of its paths go.
    fn frame(&self, vertices: &[f64], since: &[f64], axes: &[f64]) -> Result<(Frame, Vec<f64>), JsError> {
        let paths = self.rig.paths();
        if axes.len() != 4 * paths.n_paths() {
            let (given, wanted) = (axes.len(), 4 * paths.n_paths());
            return Err(JsError::new(&format!("bad_scene: {given} numbers of gradient ends given, {wanted} wanted")));
        }
        let frame = self.rig.frame(&from_flat(vertices), &from_flat(since)).map_err(raise)?;
        let mut moved = Vec::with_capacity(4 * frame.changed.len());
        for (&path, range) in frame.changed.iter().zip(frame.starts.windows(2)) {
            let at = 4 * path;
            let ends = [Point::new(axes[at], axes[at + 1]), Point::new(axes[at + 2], axes[at + 3])];
            let ends = follow_path(ends, paths.rest_path(path), &frame.points[range[0]..range[1]]);
            moved.extend(ends.iter().flat_map(|end| [end.x, end.y]));
        }
        Ok((frame, moved))
    }
}

fn numbers(indices: &[usize]) -> Vec<u32> {
    indices.iter().map(|&index| index as u32).collect()
}

/// The changed paths of a frame as points: `starts[k]..starts[k + 1]` are those of path `changed[k]`; `axes` are their
/// gradient ends, four numbers each.
#[wasm_bindgen(getter_with_clone)]
pub struct FramePoints {
    #[wasm_bindgen(readonly)]
    pub changed: Vec<u32>,
    #[wasm_bindgen(readonly)]
    pub starts: Vec<u32>,
    #[wasm_bindgen(readonly)]
    pub points: Vec<f64>,
    #[wasm_bindgen(readonly)]
    pub axes: Vec<f64>,
}

/// The changed paths of a frame as SVG path data: those of path `changed[k]` end before character `ends[k]` of `text`;
/// `axes` are their gradient ends, four numbers each.
#[wasm_bindgen(getter_with_clone)]
pub struct FrameData {
    #[wasm_bindgen(readonly)]
    pub changed: Vec<u32>,
    #[wasm_bindgen(readonly)]
    pub text: String,
    #[wasm_bindgen(readonly)]
    pub ends: Vec<u32>,
    #[wasm_bindgen(readonly)]
    pub axes: Vec<f64>,
}
