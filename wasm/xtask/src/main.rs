//! Builds the browser's WASM module: cargo for the code, wasm-bindgen's own library for the JavaScript border,
//! so that no separately installed tool must match the crate's version.

use std::path::Path;
use std::process::{Command, ExitCode};

const TARGET: &str = "wasm32-unknown-unknown";

fn main() -> ExitCode {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    match build(&root) {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("xtask: {message}");
            ExitCode::FAILURE
        }
    }
}

fn build(root: &Path) -> Result<(), String> {
    let status = Command::new("cargo")
        .args(["build", "--release", "-p", "vectortalker-browser", "--target", TARGET])
        .env("RUSTFLAGS", "-C target-feature=+simd128,+bulk-memory,+nontrapping-fptoint")
        .current_dir(root.join("wasm"))
        .status()
        .map_err(|error| format!("cargo does not start: {error}"))?;
    if !status.success() {
        return Err("the WASM build failed; its messages are above".into());
    }
    let module = root.join("wasm/target").join(TARGET).join("release/vectortalker_browser.wasm");
    wasm_bindgen_cli_support::Bindgen::new()
        .input_path(&module)
        .web(true)
        .and_then(|bindgen| bindgen.typescript(true).generate(root.join("web/src/rig/wasm")))
        .map_err(|error| format!("wasm-bindgen: {error:#}"))
}
