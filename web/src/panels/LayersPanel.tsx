/** Layers, front to back: show, hide, opacity; and what the picture weighs. */
import type { JSX } from 'preact';
import type { Scene } from '../api/schema';
import { IconButton } from '../shell/Button';
import { LAYER_NAMES, type LayerName, withLayer } from '../store/edit';
import { apply, settle, sketch } from '../store/editing';
import { edit, job, scene } from '../store/state';
import { TracePanel } from './TracePanel';

const DESCRIPTIONS: Readonly<Record<LayerName, readonly [string, string]>> = {
  local: ['Local', 'eyes, mouth'],
  fore: ['Fore', 'head, body'],
  back: ['Back', 'scenery'],
};

export function LayersPanel(): JSX.Element {
  return (
    <div class="layers-panel">
      <ul class="layers" aria-label="Layers, front to back">
        {[...LAYER_NAMES].reverse().map((name) => (
          <Layer key={name} name={name} paths={scene.value?.[name].length ?? 0} />
        ))}
      </ul>
      {scene.value && <Statistics scene={scene.value} />}
      <TracePanel />
    </div>
  );
}

function Layer({ name, paths }: { readonly name: LayerName; readonly paths: number }): JSX.Element {
  const [label, contents] = DESCRIPTIONS[name];
  const look = edit.value.layers[name];
  return (
    <li class={look.visible ? 'layer' : 'layer hidden-layer'}>
      <IconButton
        icon={look.visible ? 'eye' : 'hidden'}
        label={`Show ${label.toLowerCase()}`}
        pressed={look.visible}
        onClick={() => apply((present) => withLayer(present, name, { ...present.layers[name], visible: !look.visible }))}
      />
      <div class="layer-name">
        <strong>{label}</strong>
        <span class="quiet">
          {contents} · <span class="numeric">{paths}</span>
        </span>
      </div>
      <input
        type="range"
        aria-label={`Opacity of ${label.toLowerCase()}`}
        style={{ '--from': '0%', '--to': `${look.opacity * 100}%` }}
        min={0}
        max={1}
        step={0.01}
        value={look.opacity}
        disabled={!look.visible}
        onInput={(event) => sketch(withLayer(edit.value, name, { ...look, opacity: event.currentTarget.valueAsNumber }))}
        onChange={settle}
        onDblClick={() => apply((present) => withLayer(present, name, { ...present.layers[name], opacity: 1 }))}
      />
      <output class="numeric quiet">{Math.round(look.opacity * 100)} %</output>
    </li>
  );
}

function Statistics({ scene: { width, height, back, fore, local } }: { readonly scene: Scene }): JSX.Element {
  const paths = [...back, ...fore, ...local];
  const segments = paths.reduce((sum, path) => sum + path.points.length / 6, 0);
  const metrics = job.value?.metrics;
  return (
    <dl class="statistics">
      <Figure label="Size" value={`${width} × ${height}`} />
      <Figure label="Paths" value={`${paths.length}`} />
      <Figure label="Curves" value={`${segments}`} />
      {metrics && <Figure label="File" value={`${Math.round(metrics.bytes / 1000)} kB`} />}
      {metrics && <Figure label="Zipped" value={`${Math.round(metrics.gzip_bytes / 1000)} kB`} />}
      {metrics && <Figure label="Likeness" value={`${metrics.psnr.toFixed(1)} dB`} />}
    </dl>
  );
}

function Figure({ label, value }: { readonly label: string; readonly value: string }): JSX.Element {
  return (
    <div>
      <dt>{label}</dt>
      <dd class="numeric">{value}</dd>
    </div>
  );
}
