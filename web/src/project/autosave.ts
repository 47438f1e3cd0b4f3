/**
 * Keeps the work in IndexedDB and brings it back after a reload, undo included. A scene, a picture and a history are records of
 * their own; `current` names the three that belong together and is switched in one transaction after they are written.
 */
import { effect } from '@preact/signals';
import { type DBSchema, type IDBPDatabase, openDB } from 'idb';
import type { JobState, Landmarks, Scene } from '../api/schema';
import type { Edit } from '../store/edit';
import type { History } from '../store/history';
import { startPinning } from '../store/opening';
import { type Clip, clips, draft, history, job, type PortraitPicture, portrait, scene, session, tracedLandmarks } from '../store/state';
import { resumeTracing } from '../store/tracing';

type Stored = {
  readonly portrait: PortraitPicture;
  readonly scene: Scene | null;
  readonly history: History<Edit>;
  readonly job: { readonly state: JobState | null; readonly landmarks: Landmarks | null };
  readonly clips: readonly Clip[];
};
type Part = keyof Stored;

/** Keys of the records that belong together; older stores have no clips. */
type Current = Readonly<Record<Exclude<Part, 'clips'>, number>> & { readonly clips?: number };

type Schema = DBSchema & {
  parts: { key: number; value: Stored[Part] };
  pointer: { key: 'current'; value: Current };
};

const DATABASE = 'vectortalker';
const DELAY_MILLISECONDS = 250;

/** Opens the store, restores what it holds, and saves from then on. */
export async function startAutosave(): Promise<void> {
  const database = await openDB<Schema>(DATABASE, 1, {
    upgrade(fresh) {
      fresh.createObjectStore('parts', { autoIncrement: true });
      fresh.createObjectStore('pointer');
    },
  });
  let saved = await restore(database);
  let writing = Promise.resolve();
  let timer: ReturnType<typeof setTimeout> | undefined;
  const flush = () => {
    clearTimeout(timer);
    timer = undefined;
    writing = writing.then(async () => {
      saved = await write(database, saved);
    });
  };
  effect(() => {
    snapshot();
    timer ??= setTimeout(flush, DELAY_MILLISECONDS);
  });
  const flushNow = () => timer !== undefined && flush();
  document.addEventListener('visibilitychange', flushNow);
  window.addEventListener('pagehide', flushNow);
}

/** What is stored: the value of each part and its key. */
type Saved = { readonly values: Stored | null; readonly keys: Current | null };

/** The work as it stands; null on the first screen. Unfinished drags are not kept. */
function snapshot(): Stored | null {
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

let lastJob: Stored['job'] = { state: null, landmarks: null };

/** The same object while nothing changed, so that it is not written again. */
function jobSnapshot(state: JobState | null, landmarks: Landmarks | null): Stored['job'] {
  if (lastJob.state !== state || lastJob.landmarks !== landmarks) lastJob = { state, landmarks };
  return lastJob;
}

/** Writes the parts that changed, then switches the pointer and drops what it no longer names: all or nothing. */
async function write(database: IDBPDatabase<Schema>, saved: Saved): Promise<Saved> {
  const values = snapshot();
  const transaction = database.transaction(['parts', 'pointer'], 'readwrite');
  const parts = transaction.objectStore('parts');
  const pointer = transaction.objectStore('pointer');
  if (!values) {
    await Promise.all([parts.clear(), pointer.clear(), transaction.done]);
    return { values: null, keys: null };
  }
  const names: readonly Part[] = ['portrait', 'scene', 'history', 'job', 'clips'];
  const keep = (name: Part) => (saved.values && saved.keys && saved.values[name] === values[name] ? saved.keys[name] : null);
  const entries = await Promise.all(names.map(async (name) => [name, keep(name) ?? (await parts.add(values[name]))] as const));
  const keys = Object.fromEntries(entries) as Current;
  await pointer.put(keys, 'current');
  const stale = Object.values(saved.keys ?? {}).filter((key) => !Object.values(keys).includes(key));
  await Promise.all([...stale.map((key) => parts.delete(key)), transaction.done]);
  return { values, keys };
}

async function restore(database: IDBPDatabase<Schema>): Promise<Saved> {
  const keys = await database.get('pointer', 'current');
  if (!keys) return { values: null, keys: null };
  const read = async <P extends Exclude<Part, 'clips'>>(name: P) => (await database.get('parts', keys[name])) as Stored[P];
  const values: Stored = {
    portrait: await read('portrait'),
    scene: await read('scene'),
    history: await read('history'),
    job: await read('job'),
    clips: keys.clips === undefined ? [] : ((await database.get('parts', keys.clips)) as Stored['clips']),
  };
  if (!values.portrait || !values.history) return { values: null, keys: null };
  show(values);
  return { values, keys };
}

function show(values: Stored): void {
  portrait.value = values.portrait;
  scene.value = values.scene;
  history.value = values.history;
  clips.value = values.clips;
  draft.value = null;
  session.value = { kind: 'editing' };
  if (values.job.state) resumeTracing(values.job.state, values.job.landmarks);
  else if (!values.scene) startPinning(true);
  else tracedLandmarks.value = values.job.landmarks;
}
