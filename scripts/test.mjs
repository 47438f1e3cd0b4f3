// `npm test`: sets everything up, then runs every check: Rust, Python, TypeScript, and the journeys in a real browser.
import { main, run, SetupError, succeeds, venvBin } from './run.mjs';
import { setup } from './setup.mjs';
import { provideSystemPackages } from './system-packages.mjs';

const cargo =
  (...args) =>
  () =>
    run('cargo', args, { cwd: 'wasm' });
const python =
  (...args) =>
  () =>
    run(venvBin('python'), ['-m', ...args]);
const npm = (name) => () => run('npm', ['run', '--silent', name]);
const hasClippy = () => succeeds('cargo', ['clippy', '--version']);

/** In the order they run; `needs` names the command of a system package without which the check is left out. */
const CHECKS = [
  { name: 'Rust: format', run: cargo('fmt', '--all', '--check'), when: () => succeeds('cargo', ['fmt', '--version']) },
  { name: 'Rust: lint', run: cargo('clippy', '--workspace', '--all-targets', '--quiet', '--', '-D', 'warnings'), when: hasClippy },
  { name: 'Rust: tests', run: cargo('test', '--quiet', '-p', 'vectortalker-geometry', '-p', 'vectortalker-raster') },
  { name: 'Python: format', run: python('ruff', 'format', '--check', 'backend', 'tests', 'scripts') },
  { name: 'Python: lint', run: python('ruff', 'check', 'backend', 'tests', 'scripts') },
  { name: 'Python: types', run: python('pyright', '--project', 'backend') },
  { name: 'Python: tests', run: python('pytest', 'tests', '-q') },
  { name: 'TypeScript: lint', run: npm('lint') },
  { name: 'TypeScript: types and tests', run: npm('test:web') },
  { name: 'Browser: journeys', run: npm('test:e2e'), needs: 'chromium' },
];

main(() => {
  setup();
  const missing = provideSystemPackages();
  const absent = new Set(missing.map((item) => item.command));
  const failed = [];
  const left = [];
  for (const check of CHECKS) {
    if (absent.has(check.needs) || check.when?.() === false) {
      left.push(check.name);
      continue;
    }
    console.log(`\n── ${check.name}`);
    try {
      check.run();
    } catch (error) {
      if (!(error instanceof SetupError)) throw error;
      failed.push(check.name);
    }
  }
  for (const item of missing) console.log(`\nNot on this machine: ${item.command} (${item.needed}); what needs it was skipped.`);
  if (left.length > 0) console.log(`\nNot run, for want of a tool: ${left.join('; ')}`);
  if (failed.length > 0) throw new SetupError(`Failed: ${failed.join('; ')}`);
  console.log('\n✓ all checks passed');
});
