// `npm start`: sets everything up and serves the editor (port by PORT, default 8000).
import { handOver, main, venvBin } from './run.mjs';
import { setup } from './setup.mjs';

main(() => {
  setup();
  handOver(venvBin('vectortalker'), ['serve']);
});
