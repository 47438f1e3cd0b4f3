/** How far the tracing is: level dots, paths, time, and the two ways to end it early. */
import type { JSX } from 'preact';
import { hasEnded } from '../api/events';
import type { JobState } from '../api/schema';
import { Button } from '../shell/Button';
import { notifyAtEnd, notifying } from '../store/absence';
import { report } from '../store/notices';
import { connection, job, scene, session } from '../store/state';
import { cancelTracing, keepWhatIsThere } from '../store/tracing';

export function Progress(): JSX.Element | null {
  const state = job.value;
  if (session.value.kind === 'uploading') return <Waiting text="Sending the picture…" />;
  if (session.value.kind === 'finding') return <Waiting text="Looking for the face…" />;
  if (!state || hasEnded(state)) return null;
  return (
    <section class="progress card" aria-label="Progress">
      <LevelDots state={state} />
      <div class="progress-text">
        <strong>{connection.value === 'reconnecting' || connection.value === 'lost' ? 'Reconnecting…' : stageText(state)}</strong>
        <span class="quiet numeric">{timeText(state)}</span>
      </div>
      <div class="progress-actions">
        {scene.value && <Button onClick={() => void keepWhatIsThere()}>Good enough</Button>}
        <Button emphasis="quiet" onClick={() => void cancelTracing()}>
          Cancel
        </Button>
        <Button emphasis="quiet" disabled={notifying.value} onClick={() => void notifyAtEnd().catch(report)}>
          {notifying.value ? 'Will notify you' : 'Notify me'}
        </Button>
      </div>
      <progress class="progress-line" max={1} value={state.progress} aria-label="Progress of the tracing" />
    </section>
  );
}

function Waiting({ text }: { readonly text: string }): JSX.Element {
  return (
    <section class="progress card" aria-label="Progress">
      <strong>{text}</strong>
      <progress class="progress-line" aria-label={text} />
    </section>
  );
}

function LevelDots({ state }: { readonly state: JobState }): JSX.Element {
  const dots = Array.from({ length: state.levels }, (_, index) => index + 1);
  return (
    <div class="level-dots" role="img" aria-label={`Level ${state.level} of ${state.levels}`}>
      {dots.map((level) => (
        <i key={level} class={level < state.level ? 'done' : level === state.level ? 'now' : ''} />
      ))}
    </div>
  );
}

function stageText(state: JobState): string {
  if (state.phase === 'queued') return state.queue_position ? `In the queue, place ${state.queue_position}` : 'Starting…';
  return state.n_paths > 0 ? `${sentence(state.stage)} · ${state.n_paths} paths` : sentence(state.stage);
}

function timeText({ phase, elapsed_seconds: elapsed, remaining_seconds: remaining, estimate_s: estimate }: JobState): string {
  const left = remaining ?? estimate ?? null;
  const known = [phase === 'queued' ? [] : duration(elapsed), left === null ? [] : `about ${duration(left)} left`].flat();
  return [...known, 'goes on when this tab is closed'].join(' · ');
}

/** "8 s", "1 min 20 s". */
function duration(seconds: number): string {
  const whole = Math.max(0, Math.round(seconds));
  return whole < 60 ? `${whole} s` : `${Math.floor(whole / 60)} min ${whole % 60} s`;
}

const sentence = (text: string) => text.charAt(0).toUpperCase() + text.slice(1);
