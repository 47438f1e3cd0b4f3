// `npm run soak [PART…]`: sets everything up and runs the long tests of trust: fuzzing, kills, load, work shared by machines.
import { main, run, SetupError, venvBin } from './run.mjs';
import { setup } from './setup.mjs';
import { provideSystemPackages } from './system-packages.mjs';

const REDIS = 'redis-server';

/** In the order they run, some hour in all on two idle cores; `needs` names the command of a system package. */
const PARTS = [
  { name: 'fuzz', args: ['100000'] },
  { name: 'faults', args: ['50', 'redis'], needs: REDIS },
  { name: 'load', args: ['20', '200'] },
  { name: 'shared_work', args: ['20'], needs: REDIS },
];

main(() => {
  setup();
  const absent = new Set(provideSystemPackages().map((item) => item.command));
  const wanted = process.argv.slice(2);
  const failed = [];
  for (const { name, args, needs } of PARTS) {
    if (wanted.length > 0 && !wanted.includes(name)) continue;
    if (absent.has(needs)) {
      console.log(`\nNot run, for want of ${needs}: ${name}`);
      continue;
    }
    console.log(`\n── ${name}`);
    try {
      run(venvBin('python'), ['-m', `scripts.soak.${name}`, ...args]);
    } catch (error) {
      if (!(error instanceof SetupError)) throw error;
      failed.push(name);
    }
  }
  if (failed.length > 0) throw new SetupError(`Failed: ${failed.join('; ')}`);
});
