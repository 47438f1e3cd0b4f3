// Skips a set-up step whose inputs have not changed: a stamp file holds the hash of what the last good run read.
import { createHash } from 'node:crypto';
import { existsSync, mkdirSync, readdirSync, readFileSync, statSync, writeFileSync } from 'node:fs';
import { dirname, join, relative } from 'node:path';
import { root } from './run.mjs';

const NEVER_INPUT = new Set(['node_modules', 'target', 'dist', '__pycache__']);

function* filesBelow(path) {
  if (!statSync(path).isDirectory()) return yield path;
  for (const name of readdirSync(path).sort()) {
    if (!NEVER_INPUT.has(name)) yield* filesBelow(join(path, name));
  }
}

function hashOf(inputs) {
  const hash = createHash('sha256').update(process.version);
  for (const input of inputs) {
    for (const file of filesBelow(join(root, input))) hash.update(relative(root, file)).update(readFileSync(file));
  }
  return hash.digest('hex');
}

/**
 * Runs `step` unless its inputs (files and folders, relative to the root) are those of its last good run and `result` still exists.
 * The inputs are hashed before the step: a file changed meanwhile makes the next run do it again.
 */
export function unlessFresh(name, inputs, result, step) {
  const stamp = join(root, '.venv', 'stamps', name);
  const hash = hashOf(inputs);
  if (existsSync(join(root, result)) && existsSync(stamp) && readFileSync(stamp, 'utf8') === hash) {
    console.log(`✓ ${name}: up to date`);
    return;
  }
  console.log(`→ ${name}`);
  const start = Date.now();
  step();
  mkdirSync(dirname(stamp), { recursive: true });
  writeFileSync(stamp, hash);
  console.log(`✓ ${name} (${((Date.now() - start) / 1000).toFixed(0)} s)`);
}
