// Writes the one contract down for the browser: the server's OpenAPI document and the TypeScript types of its schemas.
// With --check nothing is written; a committed file that differs is named, and the exit code is 1.
import { readFileSync, writeFileSync } from 'node:fs';
import { pathToFileURL } from 'node:url';
import { typesOf } from './openapi-types.mjs';
import { main, output, SetupError, venvBin } from './run.mjs';

const DOCUMENT = 'web/src/api/openapi.json';
const TYPES = 'web/src/api/schema.ts';

function gen() {
  const json = output(venvBin('python'), ['-m', 'vectortalker.server.openapi']);
  if (!json) throw new SetupError('The server does not print its OpenAPI document; "npm run setup" installs it.');
  const files = { [DOCUMENT]: `${json.trim()}\n`, [TYPES]: typesOf(JSON.parse(json)) };
  if (process.argv.includes('--check')) return check(files);
  for (const [path, text] of Object.entries(files)) writeFileSync(path, text);
}

function check(files) {
  const stale = Object.entries(files).filter(([path, text]) => readFileSync(path, 'utf8') !== text);
  if (stale.length > 0)
    throw new SetupError(`Not what the schema says: ${stale.map(([path]) => path).join(', ')}. Run "npm run gen" and commit.`);
}

if (import.meta.url === pathToFileURL(process.argv[1]).href) main(gen);
