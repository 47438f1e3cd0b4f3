/** Keeps the work in the browser, a moment after every change, and brings it back after a reload, undo included. */
import { effect } from '@preact/signals';
import { resumeHearing } from '../speech/listening';
import { choices, hearing, textToSpeak } from '../speech/state';
import { tell } from '../store/notices';
import { resumeOpening } from '../store/opening';
import { clips, draft, history, job, portrait, replaced, scene, session, tracedLandmarks } from '../store/state';
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
    if (!isFirst) timer ??= setTimeout(keep, session.value.kind === 'uploading' ? 0 : DELAY_MILLISECONDS);
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

/** The work as it stands; null where there is none. Unfinished drags are not kept. */
function snapshot(): Work | null {
  const now = session.value;
  if (now.kind === 'welcome' && !now.behind) return null;
  return {
    session: now,
    portrait: portrait.value,
    scene: scene.value,
    history: history.value,
    job: jobPart({ state: job.value, landmarks: tracedLandmarks.value }),
    clips: clips.value,
    speech: speechPart({ hearing: hearing.value, choices: choices.value, text: textToSpeak.value }),
    replaced: replaced.value,
  };
}

const jobPart = keptWhileEqual<Work['job']>();
const speechPart = keptWhileEqual<NonNullable<Work['speech']>>();

/** Gives the object of the call before while every member is the same, so that it is not written again. */
function keptWhileEqual<T extends object>(): (next: T) => T {
  let last: T | null = null;
  return (next) => {
    const isSame = last !== null && (Object.keys(next) as (keyof T)[]).every((name) => last?.[name] === next[name]);
    last = isSame && last ? last : next;
    return last;
  };
}

function show(work: Work): void {
  portrait.value = work.portrait;
  scene.value = work.scene;
  history.value = work.history;
  clips.value = work.clips;
  draft.value = null;
  session.value = work.session;
  replaced.value = work.replaced;
  tracedLandmarks.value = work.job.landmarks;
  if (work.speech) {
    choices.value = work.speech.choices;
    textToSpeak.value = work.speech.text;
    hearing.value = work.speech.hearing;
  }
  if (work.job.state) void resumeTracing(work.job.state, work.job.landmarks);
  if (!work.job.state || work.session.kind === 'uploading') void resumeOpening();
  void resumeHearing();
}
