// `npm run soak [PART…]`: sets everything up and runs the long tests of trust: fuzzing, kills, load, reloads, work shared by
// machines, an hour's use.
import { main, run, SetupError, venvBin } from './run.mjs';
import { setup } from './setup.mjs';
import { provideSystemPackages } from './system-packages.mjs';

const python = (name, ...args) => ({ name, command: [venvBin('python'), ['-m', `scripts.soak.${name}`, ...args]] });
const node = (name, ...args) => ({ name, command: [process.execPath, [`scripts/soak/${name}.mjs`, ...args]] });

/** In the order they run, some two hours in all on two idle cores; `needs` names the command of a system package. */
const PARTS = [
  python('fuzz', '100000'),
  { ...python('faults', '50', 'redis'), needs: 'redis-server' },
  python('load', '20', '200'),
  { ...python('shared_work', '20'), needs: 'redis-server' },
  { ...node('reload', '40', '12'), needs: 'chromium' },
  python('endurance', '60', '20'),
];

main(() => {
  setup();
  const absent = new Set(provideSystemPackages().map((item) => item.command));
  const wanted = process.argv.slice(2);
  const failed = [];
  for (const { name, command, needs } of PARTS) {
    if (wanted.length > 0 && !wanted.includes(name)) continue;
    if (absent.has(needs)) {
      console.log(`\nNot run, for want of ${needs}: ${name}`);
      continue;
    }
    console.log(`\n── ${name}`);
    try {
      run(...command);
    } catch (error) {
      if (!(error instanceof SetupError)) throw error;
      failed.push(name);
    }
  }
  if (failed.length > 0) throw new SetupError(`Failed: ${failed.join('; ')}`);
});
