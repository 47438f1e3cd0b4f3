/** Actions on the job that turns the portrait into a scene: start, follow, keep what is there, cancel. */
import { cancelJob, finishJob, getJob, getScene, postJob, postPortrait, RequestError, STANDARD_OPTIONS } from '../api/client';
import { followJob, hasEnded } from '../api/events';
import type { JobState, Landmarks } from '../api/schema';
import { announce, report, tell } from './notices';
import { connection, history, job, portrait, preset, scene, tracedLandmarks } from './state';

let stopFollowing = () => {};
let fetchedRevision = 0;

/** Traces the open portrait anew with the present rest landmarks. The old scene stays until the first new one comes. */
export async function startTracing(): Promise<void> {
  leaveJob();
  try {
    const landmarks = history.value.present.landmarks;
    const state = await postJob(await portraitOnServer(), landmarks, { ...STANDARD_OPTIONS, preset: preset.value });
    follow(state, landmarks);
  } catch (error) {
    report(error, { label: 'Try again', run: () => void startTracing() });
  }
}

/** Takes up a job again after a reload; one that the server has dropped starts anew. */
export async function resumeTracing(state: JobState, landmarks: Landmarks | null): Promise<void> {
  job.value = state;
  tracedLandmarks.value = landmarks;
  if (hasEnded(state)) return;
  follow(state, landmarks);
  await getJob(state.id).catch((error: unknown) => {
    if (error instanceof RequestError && error.code === 'not_found' && job.value?.id === state.id) void startTracing();
  });
}

/** Stops following, for another portrait; the server's work is cancelled. */
export function leaveJob(): void {
  stopFollowing();
  const running = job.value;
  if (running && !hasEnded(running)) cancelJob(running.id).catch(() => undefined); // the server drops the job with its portrait anyway
  job.value = null;
  connection.value = null;
}

export async function keepWhatIsThere(): Promise<void> {
  if (job.value) await finishJob(job.value.id).catch(report);
}

export async function cancelTracing(): Promise<void> {
  if (job.value) await cancelJob(job.value.id).catch(report);
}

function follow(state: JobState, landmarks: Landmarks | null): void {
  fetchedRevision = 0;
  job.value = state;
  tracedLandmarks.value = landmarks;
  stopFollowing = followJob(state.id, {
    onConnection: (next) => {
      connection.value = next;
    },
    onState: (next) => {
      receive(next).catch(report);
    },
  });
}

/** A job counts as ended once its last scene is on the stage. */
async function receive(state: JobState): Promise<void> {
  if (state.level !== job.value?.level && state.level > 0) announce(`Level ${state.level} of ${state.levels}, ${state.n_paths} paths`);
  if (!hasEnded(state)) job.value = state;
  try {
    if (state.scene_revision > fetchedRevision) await fetchScene(state);
  } finally {
    if (hasEnded(state) && job.value?.id === state.id) end(state);
  }
}

function end(state: JobState): void {
  job.value = state;
  connection.value = null;
  sayHowItEnded(state);
}

/** Scenes may be asked for while an earlier answer is on its way; the newest wins. */
async function fetchScene(state: JobState): Promise<void> {
  fetchedRevision = state.scene_revision;
  const next = await getScene(state.id);
  if (job.value?.id === state.id && state.scene_revision >= fetchedRevision) scene.value = next;
}

function sayHowItEnded(state: JobState): void {
  switch (state.phase) {
    case 'done':
      announce(`Done: ${state.n_paths} paths`);
      return;
    case 'cancelled':
      tell({ kind: 'advice', text: scene.value ? 'Cancelled. The last picture stays.' : 'Cancelled.', action: again });
      return;
    case 'failed':
      tell({ kind: 'error', text: state.error?.message ?? 'The work failed.', action: again });
      return;
    case 'queued':
    case 'running':
      return;
    default: {
      const unknown: never = state.phase;
      throw new RangeError(`Unknown phase ${unknown}`);
    }
  }
}

const again = { label: 'Trace again', run: () => void startTracing() };

/** The server's name of the open portrait; uploads its picture if it came from a project file. */
async function portraitOnServer(): Promise<string> {
  const open = portrait.value;
  if (!open) throw new Error('No portrait is open');
  if (open.id) return open.id;
  if (!open.picture) throw new Error('This project holds no source picture to trace again.');
  const posted = await postPortrait(open.picture, open.name);
  portrait.value = { ...open, id: posted.id };
  return posted.id;
}
