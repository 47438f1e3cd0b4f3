/** The work on one portrait as a whole: taken off the stage, and put onto it. */
import { batch } from '@preact/signals';
import { leaveSpeech } from '../speech/listening';
import { dismiss } from './notices';
import {
  clips,
  draft,
  history,
  job,
  type Opened,
  type PortraitWork,
  playing,
  portrait,
  type Session,
  scene,
  session,
  timeSeconds,
  tracedLandmarks,
} from './state';
import { leaveJob } from './tracing';

let opening = new AbortController();

/** Stops what is still being opened; the signal is that of what is opened next. */
export function startOpening(): AbortSignal {
  opening.abort();
  opening = new AbortController();
  return opening.signal;
}

export const openingSignal = (): AbortSignal => opening.signal;

/** Takes everything off the stage; what is still being opened or traced is stopped. */
export function clearStage(): void {
  startOpening();
  emptyStage();
}

export function emptyStage(): void {
  leaveJob();
  leaveSpeech();
  dismiss();
  batch(() => {
    draft.value = null;
    portrait.value = null;
    scene.value = null;
    tracedLandmarks.value = null;
    clips.value = [];
    playing.value = false;
    timeSeconds.value = 0;
  });
}

/** Null where no portrait has been opened. */
export function workOnStage(): PortraitWork | null {
  const opened = openedIn(session.value);
  if (!opened || !portrait.value) return null;
  return {
    session: opened,
    portrait: portrait.value,
    scene: scene.value,
    history: history.value,
    job: { state: job.value, landmarks: tracedLandmarks.value },
    clips: clips.value,
  };
}

/** Puts a portrait on an empty stage, at once: nothing sees the scene of one with the landmarks of another. */
export function putOnStage(work: PortraitWork): void {
  batch(() => {
    portrait.value = work.portrait;
    scene.value = work.scene;
    history.value = work.history;
    clips.value = work.clips;
    job.value = work.job.state;
    tracedLandmarks.value = work.job.landmarks;
    session.value = work.session;
  });
}

/** What is on the stage, or waits behind the first screen or behind a picture on its way. */
function openedIn(now: Session): Opened | null {
  if (now.kind === 'welcome') return now.behind && openedIn(now.behind);
  return now.kind === 'uploading' ? openedIn(now.before) : now;
}
