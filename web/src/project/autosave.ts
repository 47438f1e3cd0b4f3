/** Keeps the work in the browser, a moment after every change, and brings it back after a reload, undo included. */
import { effect } from '@preact/signals';
import type { JobState, Landmarks } from '../api/schema';
import { tell } from '../store/notices';
import { resumeOpening } from '../store/opening';
import { clips, draft, history, job, portrait, scene, session, tracedLandmarks } from '../store/state';
import { resumeTracing } from '../store/tracing';
import { type Work, WorkStore } from './workStore';

const DELAY_MILLISECONDS = 250;

let keepNow = async (): Promise<void> => {};

/** Opens the store, restores what it holds, and saves from then on. */
export async function startAutosave(): Promise<void> {
  const store = await WorkStore.open();
  const restored = await store.read();
  if (restored) show(restored);
  let timer: ReturnType<typeof setTimeout> | undefined;
  keepNow = () => {
    clearTimeout(timer);
    timer = undefined;
    return store.keep(snapshot());
  };
  const keep = () => void keepNow().catch(tellThatItFailed);
  let isFirst = true;
  effect(() => {
    snapshot();
    if (!isFirst) timer ??= setTimeout(keep, DELAY_MILLISECONDS);
    isFirst = false;
  });
  const keepBeforeLeaving = () => timer !== undefined && keep();
  document.addEventListener('visibilitychange', keepBeforeLeaving);
  window.addEventListener('pagehide', keepBeforeLeaving);
}

/** Resolves when the browser has stored the work as it stands. */
export const workKept = (): Promise<void> => keepNow();

function tellThatItFailed(error: unknown): void {
  const why = error instanceof Error ? error.message || error.name : String(error);
  tell({ kind: 'error', text: `The browser could not keep your work (${why.replace(/\.$/, '')}). Save it as a file before you leave.` });
}

/** The work as it stands; null on the first screen. Unfinished drags are not kept. */
function snapshot(): Work | null {
  const open = portrait.value;
  if (!open || session.value.kind === 'welcome') return null;
  return {
    portrait: open,
    scene: scene.value,
    history: history.value,
    job: jobSnapshot(job.value, tracedLandmarks.value),
    clips: clips.value,
  };
}

let lastJob: Work['job'] = { state: null, landmarks: null };

/** The same object while nothing changed, so that it is not written again. */
function jobSnapshot(state: JobState | null, landmarks: Landmarks | null): Work['job'] {
  if (lastJob.state !== state || lastJob.landmarks !== landmarks) lastJob = { state, landmarks };
  return lastJob;
}

function show(work: Work): void {
  portrait.value = work.portrait;
  scene.value = work.scene;
  history.value = work.history;
  clips.value = work.clips;
  draft.value = null;
  session.value = { kind: 'editing' };
  if (work.job.state) resumeTracing(work.job.state, work.job.landmarks);
  else if (!work.scene) void resumeOpening();
  else tracedLandmarks.value = work.job.landmarks;
}
