// Sets everything up in the clone: npm packages, Python environment, Rust core for Python and for the browser, web page.
// Each step is skipped while its inputs are unchanged.
import { pathToFileURL } from 'node:url';
import { main, run, succeeds, venvBin } from './run.mjs';
import { unlessFresh } from './stamps.mjs';
import { requireTools } from './tools.mjs';

const UV = 'uv==0.13.9';
const PYTHON_INPUTS = ['requirements.lock', 'torch.txt', 'torch-pypi-libraries.txt', 'pyproject.toml'].map((name) => `backend/${name}`);
const pip = (...args) => run(venvBin('uv'), ['pip', ...args], { env: { VIRTUAL_ENV: '.venv' } });

function installPython(python) {
  run(python, ['-m', 'venv', '--clear', '.venv']);
  run(venvBin('python'), ['-m', 'pip', 'install', '--quiet', '--disable-pip-version-check', UV]);
  pip('install', '--quiet', '--compile-bytecode', '--require-hashes', '-r', 'backend/requirements.lock');
  installTorch();
  pip('install', '--quiet', '--no-deps', '--no-build-isolation', '-e', 'backend');
}

/** The CPU build where its index can be reached; else PyPI's, on Linux with the GPU libraries its import asks for. */
function installTorch() {
  const install = ['install', '--quiet', '--compile-bytecode', '--no-deps', '-r', 'backend/torch.txt'];
  const cpuBuild = succeeds(venvBin('uv'), ['pip', ...install, '--torch-backend', 'cpu'], {
    env: { ...process.env, VIRTUAL_ENV: '.venv' },
  });
  if (cpuBuild) return;
  console.log('  the CPU build of torch cannot be reached; taking the one on PyPI');
  pip(...install, ...(process.platform === 'linux' ? ['-r', 'backend/torch-pypi-libraries.txt'] : []));
}

export function setup() {
  const python = requireTools();
  unlessFresh('Python environment', PYTHON_INPUTS, '.venv/bin/vectortalker', () => installPython(python));
  unlessFresh('npm packages', ['package.json', 'package-lock.json'], 'node_modules', () => run('npm', ['ci', '--no-audit', '--no-fund']));
  unlessFresh('Rust core for Python', ['wasm'], '.venv/bin/vectortalker', () =>
    run(venvBin('maturin'), ['develop', '--release', '--uv', '--quiet'], { cwd: 'wasm/python', env: { VIRTUAL_ENV: '../../.venv' } }),
  );
  unlessFresh('Rust core for the browser', ['wasm'], 'web/src/rig/wasm', () =>
    run('cargo', ['run', '--quiet', '-p', 'xtask'], { cwd: 'wasm' }),
  );
  unlessFresh('web page', ['web', 'public', 'package-lock.json', 'wasm'], 'web/dist/index.html', () =>
    run('npm', ['run', '--silent', 'build']),
  );
}

if (import.meta.url === pathToFileURL(process.argv[1]).href) main(setup);
