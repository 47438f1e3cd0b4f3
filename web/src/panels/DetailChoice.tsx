/** How fine the tracing is: the vectoriser's presets. */
import type { JSX } from 'preact';
import type { VectorizeOptions } from '../api/schema';
import { preset } from '../store/state';

const PRESETS: readonly { readonly name: VectorizeOptions['preset']; readonly label: string; readonly meaning: string }[] = [
  { name: 'draft', label: 'Draft', meaning: 'Coarse, in a few seconds' },
  { name: 'standard', label: 'Standard', meaning: '500 shapes, in about a minute' },
  { name: 'fine', label: 'Fine', meaning: 'More shapes, in some minutes' },
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

export const detailMeaning = (name: VectorizeOptions['preset']) => PRESETS.find((preset) => preset.name === name)?.meaning ?? '';

function choose(name: VectorizeOptions['preset']): void {
  preset.value = name;
}
