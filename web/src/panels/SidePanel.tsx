/** The side panel and its tabs. */
import type { JSX } from 'preact';
import { IconButton } from '../shell/Button';
import { SpeechPanel } from '../speech/SpeechPanel';
import { toggle } from '../store/looking';
import { panel, panelFolded } from '../store/state';
import { LayersPanel } from './LayersPanel';
import { PosePanel } from './PosePanel';

const TABS = [
  { name: 'layers', label: 'Layers', Panel: LayersPanel },
  { name: 'pose', label: 'Pose', Panel: PosePanel },
  { name: 'speech', label: 'Speech', Panel: SpeechPanel },
] as const;

export function SidePanel(): JSX.Element {
  const { name: shown, label, Panel } = TABS.find(({ name }) => name === panel.value) ?? TABS[0];
  const arrow = (event: KeyboardEvent) => {
    if (event.key !== 'ArrowLeft' && event.key !== 'ArrowRight') return;
    const place = TABS.findIndex(({ name }) => name === shown) + (event.key === 'ArrowLeft' ? TABS.length - 1 : 1);
    panel.value = TABS[place % TABS.length].name;
    document.getElementById(`tab-${panel.value}`)?.focus();
  };
  return (
    <aside class={panelFolded.value ? 'side-panel folded' : 'side-panel'} aria-label="Panels">
      <div class="panel-head">
        <div class="tabs" role="tablist" aria-label="Panels" onKeyDown={arrow}>
          {TABS.map((tab) => (
            <button
              key={tab.name}
              id={`tab-${tab.name}`}
              type="button"
              role="tab"
              aria-selected={tab.name === shown}
              aria-controls="side-panel-body"
              tabIndex={tab.name === shown ? 0 : -1}
              onClick={() => show(tab.name)}
            >
              {tab.label}
            </button>
          ))}
        </div>
        <IconButton
          icon={panelFolded.value ? 'unfold' : 'fold'}
          label={panelFolded.value ? 'Show the panel' : 'Hide the panel'}
          onClick={() => toggle(panelFolded)}
        />
      </div>
      <div class="panel-body" id="side-panel-body" role="tabpanel" aria-label={label}>
        <Panel />
      </div>
    </aside>
  );
}

function show(name: typeof panel.value): void {
  panel.value = name;
  panelFolded.value = false;
}
