/** Starts the editor. */
import { render } from 'preact';
import { watchLeaving } from './api/leaving';
import { startAutosave } from './project/autosave';
import { loadRigModule } from './rig/rig';
import { App } from './shell/App';
import { followSound } from './speech/sound';
import { followChoices } from './speech/state';
import { rigModuleReady } from './stage/posing';
import { report } from './store/notices';
import { keepPreferences } from './store/preferences';
import { loadSampleTracks } from './timeline/samples';
import { loadSamples } from './welcome/samples';
import './styles/index.css';

async function start(root: HTMLElement): Promise<void> {
  watchLeaving();
  keepPreferences();
  followSound();
  followChoices();
  await startAutosave().catch(report); // before the first paint, so that a reload does not flash the first screen
  render(<App />, root);
  loadSamples().catch(report);
  loadSampleTracks().catch(report);
  loadRigModule()
    .then(() => {
      rigModuleReady.value = true;
    })
    .catch(report);
}

const root = document.getElementById('app');
if (!root) throw new Error('The page has no element #app');
start(root).catch(report);
