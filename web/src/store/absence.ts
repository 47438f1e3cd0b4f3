/** Tells people who look elsewhere that the tracing has ended: in the page's title, and if they asked for it by a sound and a notification. */
import { effect, signal } from '@preact/signals';
import { hasEnded } from '../api/events';
import type { JobState } from '../api/schema';
import { chime } from './chime';
import { report, tell } from './notices';
import { documentName, job } from './state';

/** How the tracing ended while nobody looked; null when somebody looks. */
export const endedUnseen = signal<string | null>(null);
/** Whether the end of the tracing is told by a sound and, where the browser lets it, by a notification. */
export const notifying = signal(false);

const canNotify = () => 'Notification' in window && Notification.permission === 'granted';

/** Asks the browser for its leave; browsers want a press to come first. */
export async function notifyAtEnd(): Promise<void> {
  notifying.value = true;
  if ('Notification' in window) await Notification.requestPermission();
  if (!canNotify())
    tell({
      kind: 'advice',
      text: 'The browser lets this page send no notifications. A sound and the title of its tab say when it is done.',
    });
}

/** Watches the job until the returned function is called. */
export function watchEnd(): () => void {
  let running: string | null = null;
  const isAway = () => document.visibilityState === 'hidden';
  const look = () => {
    if (!isAway()) endedUnseen.value = null;
  };
  const dispose = effect(() => {
    const state = job.value;
    const hasJustEnded = state !== null && hasEnded(state) && state.id === running;
    running = state && !hasEnded(state) ? state.id : null;
    if (hasJustEnded && isAway()) tellAway(endOf(state));
  });
  document.addEventListener('visibilitychange', look);
  return () => {
    dispose();
    document.removeEventListener('visibilitychange', look);
  };
}

function tellAway(text: string): void {
  endedUnseen.value = text;
  if (!notifying.value) return;
  chime().catch(report);
  if (!canNotify()) return;
  const notification = new Notification(`${documentName.peek()}: ${text}`);
  notification.onclick = () => {
    window.focus();
    notification.close();
  };
}

const endOf = ({ phase, n_paths }: JobState) => (phase === 'done' ? `done, ${n_paths} paths` : phase);
