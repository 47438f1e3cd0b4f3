/** Tells people who look elsewhere that the tracing has ended: in the page's title, and by a notification if they asked for one. */
import { effect, signal } from '@preact/signals';
import { hasEnded } from '../api/events';
import type { JobState } from '../api/schema';
import { tell } from './notices';
import { documentName, job } from './state';

/** How the tracing ended while nobody looked; null when somebody looks. */
export const endedUnseen = signal<string | null>(null);
/** Whether the end of the tracing is told by a notification. */
export const notifying = signal(false);

export const canAskToNotify = () => 'Notification' in window && Notification.permission !== 'denied';

/** Asks the browser for its leave; browsers want a press to come first. */
export async function notifyAtEnd(): Promise<void> {
  notifying.value = (await Notification.requestPermission()) === 'granted';
  if (!notifying.value)
    tell({ kind: 'advice', text: 'The browser lets this page send no notifications. The title of its tab says when it is done.' });
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
  const notification = new Notification(`${documentName.peek()}: ${text}`);
  notification.onclick = () => {
    window.focus();
    notification.close();
  };
}

const endOf = ({ phase, n_paths }: JobState) => (phase === 'done' ? `done, ${n_paths} paths` : phase);
