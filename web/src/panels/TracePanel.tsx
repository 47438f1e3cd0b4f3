/** Tracing the portrait again: finer, quicker, or after the landmarks were corrected. */
import type { JSX } from 'preact';
import { hasEnded } from '../api/events';
import type { VectorizeOptions } from '../api/schema';
import { Button } from '../shell/Button';
import { startPinning } from '../store/opening';
import { history, job, portrait, preset, session, tracedLandmarks } from '../store/state';
import { startTracing } from '../store/tracing';

const PRESETS: readonly { readonly name: VectorizeOptions['preset']; readonly label: string }[] = [
  { name: 'draft', label: 'Draft' },
  { name: 'standard', label: 'Standard' },
  { name: 'fine', label: 'Fine' },
];

export function TracePanel(): JSX.Element {
  const isBusy = session.value.kind !== 'editing' || (job.value !== null && !hasEnded(job.value));
  const isCorrected = history.value.present.landmarks !== tracedLandmarks.value;
  return (
    <section class="trace-panel" aria-label="Tracing">
      <h2>Tracing</h2>
      <fieldset class="segmented">
        <legend class="visually-hidden">Detail</legend>
        {PRESETS.map(({ name, label }) => (
          <label key={name}>
            <input type="radio" name="detail" checked={preset.value === name} onChange={() => choose(name)} />
            <span>{label}</span>
          </label>
        ))}
      </fieldset>
      {isCorrected && portrait.value && (
        <p class="quiet">The landmarks have been corrected since; eyes and mouth are cut best when traced again.</p>
      )}
      <div class="row">
        <Button disabled={isBusy || !portrait.value?.picture} onClick={() => void startTracing()}>
          Trace again
        </Button>
        <Button emphasis="quiet" disabled={isBusy || !portrait.value} onClick={() => startPinning(false)}>
          Five pins…
        </Button>
      </div>
    </section>
  );
}

function choose(name: VectorizeOptions['preset']): void {
  preset.value = name;
}
