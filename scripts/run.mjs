// Runs a command of the set-up or the tests, and says in one line what failed.
import { spawn, spawnSync } from 'node:child_process';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

export const root = join(dirname(fileURLToPath(import.meta.url)), '..');
export const venvBin = (name) => join(root, '.venv', process.platform === 'win32' ? 'Scripts' : 'bin', name);

/** A fault the user can mend: printed as one line, without a stack. */
export class SetupError extends Error {}

/** Runs `command` in `cwd` (relative to the root), its output passed through; throws if it fails. */
export function run(command, args, { cwd = '.', env = {} } = {}) {
  const { status, error } = spawnSync(command, args, { cwd: join(root, cwd), stdio: 'inherit', env: { ...process.env, ...env } });
  if (error) throw new SetupError(`${command} does not start: ${error.message}`);
  if (status !== 0) throw new SetupError(`"${[command, ...args].join(' ')}" ended with code ${status}; its messages are above.`);
}

/** Whether `command` runs and succeeds, output discarded. */
export function succeeds(command, args, options = {}) {
  return spawnSync(command, args, { cwd: root, stdio: 'ignore', ...options }).status === 0;
}

/** Standard output of `command`, trimmed, or null if it does not run. */
export function output(command, args) {
  const { status, stdout } = spawnSync(command, args, { cwd: root, encoding: 'utf8' });
  return status === 0 ? stdout.trim() : null;
}

/** Replaces this process's work by `command`: signals are handed on, the exit code is taken over. */
export function handOver(command, args, env = {}) {
  const child = spawn(command, args, { cwd: root, stdio: 'inherit', env: { ...process.env, ...env } });
  for (const signal of ['SIGINT', 'SIGTERM']) process.on(signal, () => child.kill(signal));
  child.on('exit', (code, signal) => process.exit(signal ? 1 : (code ?? 1)));
}

/** Runs the body of a script; a SetupError becomes one line and exit code 1. */
export async function main(body) {
  try {
    await body();
  } catch (error) {
    if (!(error instanceof SetupError)) throw error;
    console.error(`\n✗ ${error.message}`);
    process.exit(1);
  }
}
