//! Border between Python and the Rust core: numpy arrays in, numpy arrays out.

use pyo3::prelude::*;

mod geometry;
mod raster;
mod smil;

#[pymodule]
fn vectortalker_core(module: &Bound<'_, PyModule>) -> PyResult<()> {
    raster::register(module)?;
    geometry::register(module)?;
    smil::register(module)
}
