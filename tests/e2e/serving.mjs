/** Starts the editor's server for scripts that drive it by hand: on a free port, with data of its own. */
import { spawn } from 'node:child_process';
import { mkdtempSync } from 'node:fs';
import { createServer } from 'node:net';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

const COMMAND = join(import.meta.dirname, '../../.venv/bin/vectortalker');
const ATTEMPTS = 240; // of a quarter of a second

/** @returns {Promise<{ url: string, stop: () => void }>} */
export async function serveEditor() {
  const port = await freePort();
  const data = mkdtempSync(join(tmpdir(), 'vectortalker-editor-'));
  const server = spawn(COMMAND, ['serve', '--port', `${port}`, '--data', data], { stdio: 'ignore' });
  const url = `http://127.0.0.1:${port}/`;
  const stop = () => server.kill('SIGTERM');
  for (let attempt = 0; attempt < ATTEMPTS; attempt += 1) {
    const answer = await fetch(`${url}api/health`).catch(() => null);
    if (answer?.ok) return { url, stop };
    await new Promise((resolve) => setTimeout(resolve, 250));
  }
  stop();
  throw new Error(`The server does not answer at ${url}`);
}

/** @returns {Promise<number>} */
function freePort() {
  return new Promise((resolve) => {
    const probe = createServer().listen(0, '127.0.0.1', () => {
      const { port } = /** @type {import('node:net').AddressInfo} */ (probe.address());
      probe.close(() => resolve(port));
    });
  });
}
