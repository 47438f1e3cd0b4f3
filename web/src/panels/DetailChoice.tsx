/** How fine the tracing is: the vectoriser's presets. */
import type { JSX } from 'preact';
import type { VectorizeOptions } from '../api/schema';
import { preset } from '../store/state';

const PRESETS: readonly { readonly name: VectorizeOptions['preset']; readonly label: string; readonly meaning: string }[] = [
  { name: 'draft', label: 'Draft', meaning: 'a few seconds, coarse' },
  { name: 'standard', label: 'Standard', meaning: 'about a minute, 500 paths' },
  { name: 'fine', label: 'Fine', meaning: 'some minutes, more paths' },
];

export function DetailChoice(): JSX.Element {
  return (
    <fieldset class="segmented">
      <legend class="visually-hidden">Detail</legend>
      {PRESETS.map(({ name, label, meaning }) => (
        <label key={name} title={meaning}>
          <input type="radio" name="detail" checked={preset.value === name} onChange={() => choose(name)} />
          <span>{label}</span>
        </label>
      ))}
    </fieldset>
  );
}

function choose(name: VectorizeOptions['preset']): void {
  preset.value = name;
}
