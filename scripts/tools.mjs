// Finds the tools a fresh machine must have, and names what is missing and how to get it.
import { existsSync } from 'node:fs';
import { output, run, SetupError, succeeds } from './run.mjs';

const WASM_TARGET = 'wasm32-unknown-unknown';
const PYTHONS = ['python3', 'python3.13', 'python3.12', 'python3.11', 'python'];

/** Name of a Python of at least 3.11, or null. */
function findPython() {
  const check = 'import sys, venv, ensurepip; sys.exit(sys.version_info < (3, 11))';
  return PYTHONS.find((name) => succeeds(name, ['-c', check])) ?? null;
}

/** Checks Node, Python, Rust, the C compiler and Rust's WASM target; returns the Python to use. */
export function requireTools() {
  const missing = [];
  const node = Number(process.versions.node.split('.')[0]);
  if (node < 20) missing.push(`Node ${process.version} is too old; version 20 or newer is needed: https://nodejs.org`);
  const python = findPython();
  if (!python) missing.push('Python 3.11 or newer with venv is missing: https://python.org, or "apt install python3 python3-venv"');
  if (!succeeds('cargo', ['--version'])) missing.push('Rust (cargo) is missing: https://rustup.rs');
  if (!succeeds('cc', ['--version'])) missing.push('A C compiler (cc) is missing: "apt install gcc", or the Xcode command line tools');
  if (missing.length > 0) throw new SetupError(`Missing on this machine:\n  - ${missing.join('\n  - ')}`);
  requireWasmTarget();
  return python;
}

function requireWasmTarget() {
  const folder = output('rustc', ['--print', 'target-libdir', '--target', WASM_TARGET]);
  if (folder && existsSync(folder)) return;
  if (!succeeds('rustup', ['--version'])) {
    throw new SetupError(`Rust's target ${WASM_TARGET} is missing, and rustup, which could add it, too: https://rustup.rs`);
  }
  console.log(`→ Rust target ${WASM_TARGET}`);
  run('rustup', ['target', 'add', WASM_TARGET]);
}
