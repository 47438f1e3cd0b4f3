/** Tracing the portrait again: finer, quicker, or after the landmarks were corrected. */
import type { JSX } from 'preact';
import { hasEnded } from '../api/events';
import { Button } from '../shell/Button';
import { areSameLandmarks } from '../store/edit';
import { startPinning } from '../store/opening';
import { history, job, portrait, session, tracedLandmarks } from '../store/state';
import { startTracing } from '../store/tracing';
import { DetailChoice } from './DetailChoice';

export function TracePanel(): JSX.Element {
  const isBusy = session.value.kind !== 'editing' || (job.value !== null && !hasEnded(job.value));
  const isCorrected = !areSameLandmarks(history.value.present.landmarks, tracedLandmarks.value);
  return (
    <section class="trace-panel" aria-label="Tracing">
      <h2>Tracing</h2>
      <DetailChoice />
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
