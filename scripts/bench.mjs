// `npm run bench`: sets everything up and prints the benchmark tables; options are handed on.
import { handOver, main, venvBin } from './run.mjs';
import { setup } from './setup.mjs';

main(() => {
  setup();
  handOver(venvBin('vectortalker'), ['bench', ...process.argv.slice(2)]);
});
