//! Browser face of animated SVG.

use geometry::point::from_flat;
use geometry::smil::{Fill, Options, Picture, RiggedMotion, write};
use wasm_bindgen::prelude::*;

use crate::BrowserRig;

#[wasm_bindgen(js_class = Rig)]
impl BrowserRig {
    /// An animated SVG of the rigged scene.
    ///
    /// `canvas` is red, green, blue; `layers` the numbers of back and fore paths; `openings` the opening of each local
    /// path; `fills` 13 numbers a path as in `Fill::from_flat`; `axes` both gradient ends of every path at rest;
    /// `vertices` all frames, evenly spaced over `duration` seconds, one after another.
    ///
    /// # Errors
    /// When they do not fit together.
    #[wasm_bindgen(js_name = animatedSvg)]
    #[expect(clippy::too_many_arguments, reason = "flat arrays only cross the border")]
    pub fn animated_svg(
        &self,
        width: f64,
        height: f64,
        canvas: &[u8],
        layers: &[u32],
        openings: &[u32],
        fills: &[f64],
        axes: &[f64],
        vertices: &[f64],
        duration: f64,
        tolerance: f64,
        looped: bool,
        title: &str,
        description: &str,
    ) -> Result<String, JsError> {
        let misfit = || JsError::new("bad_scene: picture, gradient ends, frames and options do not fit the rig");
        let &[n_back, n_fore] = layers else { return Err(misfit()) };
        let picture = Picture {
            width,
            height,
            canvas: canvas.try_into().map_err(|_| misfit())?,
            n_back: n_back as usize,
            n_fore: n_fore as usize,
            fills: Fill::from_flat(fills),
            openings: openings.iter().map(|&opening| opening as usize).collect(),
        };
        let options = Options { duration, tolerance, looped, title, description };
        RiggedMotion::new(&self.rig, &from_flat(vertices), &from_flat(axes))
            .filter(|_| picture.is_whole() && options.is_sound())
            .map(|motion| write(&picture, &motion, &options))
            .ok_or_else(misfit)
    }
}
