// System packages that only tests or options need: installed as root on Debian, else named with the command to type.
import { existsSync } from 'node:fs';
import { output, run } from './run.mjs';

/** Command to look for, Debian package that brings it, and what cannot run without it. */
export const OPTIONAL = [
  { command: 'chromium', package: 'chromium', needed: 'browser tests' },
  { command: 'espeak-ng', package: 'espeak-ng', needed: 'transcripts of speech and their tests' },
  { command: 'potrace', package: 'potrace', needed: 'a tracer that the benchmark compares with, and its test' },
  { command: 'redis-server', package: 'redis-server', needed: 'a queue that several machines share and its tests' },
];

const isPresent = ({ command }) => output('sh', ['-c', `command -v ${command}`]) !== null;
const isRootOnDebian = () => process.getuid?.() === 0 && existsSync('/etc/debian_version');

/** Installs what is missing where that is possible; returns what is still missing. */
export function provideSystemPackages() {
  const missing = OPTIONAL.filter((item) => !isPresent(item));
  if (missing.length === 0) return [];
  const names = missing.map((item) => item.package);
  if (!isRootOnDebian()) {
    console.log(`! Not installed: ${names.join(', ')}. To have them: sudo apt-get install ${names.join(' ')}`);
    return missing;
  }
  console.log(`→ Debian packages: ${names.join(', ')}`);
  const quiet = { env: { DEBIAN_FRONTEND: 'noninteractive' } };
  run('apt-get', ['-qq', 'update'], quiet);
  run('apt-get', ['-qq', 'install', '-y', '--no-install-recommends', ...names], quiet);
  return missing.filter((item) => !isPresent(item));
}
