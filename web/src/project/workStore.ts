/**
 * The open work as records of IndexedDB. A scene, a picture and a history are records of their own; `current` names those that
 * belong together. Every request of a write is made at once, without waiting for an answer, so that a write that starts while
 * the page is being left still ends.
 */
import { type DBSchema, type IDBPDatabase, type IDBPTransaction, openDB } from 'idb';
import type { Choices } from '../speech/speechTrack';
import type { Hearing } from '../speech/state';
import type { PortraitWork, Replaced, Session } from '../store/state';

/** `portrait` is null while the first picture is on its way to the server. */
export type Work = Omit<PortraitWork, 'session'> & {
  readonly session: Session;
  /** What is under way and typed in the speech panel. */
  readonly speech: { readonly hearing: Hearing | null; readonly choices: Choices; readonly text: string } | null;
  readonly replaced: Replaced;
};
type Part = keyof Work;
const PARTS: readonly Part[] = ['session', 'portrait', 'scene', 'history', 'job', 'clips', 'speech', 'replaced'];

/** Older stores numbered their records and have fewer parts. */
type Key = string | number;
type LaterPart = 'session' | 'clips' | 'speech' | 'replaced';
type Current = Readonly<Record<Exclude<Part, LaterPart>, Key>> & { readonly [part in LaterPart]?: Key };

type Schema = DBSchema & {
  parts: { key: Key; value: Work[Part] };
  pointer: { key: 'current'; value: Current };
};

type Writing = IDBPTransaction<Schema, ['parts', 'pointer'], 'readwrite'>;
type Requests = readonly Promise<unknown>[];

/** What this page knows to be stored; null where another page may have written. */
type Stored = { readonly work: Work; readonly keys: Current };

const NAME = 'vectortalker';

export class WorkStore {
  private stored: Stored | null = null;
  private readonly database: IDBPDatabase<Schema>;
  /** Pages of one browser share the store: the last to write owns it. */
  private readonly pages = new BroadcastChannel(NAME);

  private constructor(database: IDBPDatabase<Schema>) {
    this.database = database;
    this.pages.onmessage = () => {
      this.stored = null;
    };
  }

  static async open(): Promise<WorkStore> {
    const database = await openDB<Schema>(NAME, 1, {
      upgrade(fresh) {
        fresh.createObjectStore('parts', { autoIncrement: true });
        fresh.createObjectStore('pointer');
      },
    });
    return new WorkStore(database);
  }

  /** The work that was kept last; null when there is none. */
  async read(): Promise<Work | null> {
    const keys = await this.database.get('pointer', 'current');
    if (!keys) return null;
    const part = async (key: Key | undefined) => (key === undefined ? undefined : await this.database.get('parts', key));
    const work = {
      session: (await part(keys.session)) ?? { kind: 'editing' },
      portrait: await part(keys.portrait),
      scene: await part(keys.scene),
      history: await part(keys.history),
      job: await part(keys.job),
      clips: (await part(keys.clips)) ?? [],
      speech: (await part(keys.speech)) ?? null,
      replaced: (await part(keys.replaced)) ?? { before: [], after: [] },
    } as Work;
    if (!work.history) return null;
    this.stored = { work, keys };
    return work;
  }

  /** Keeps `work` in the place of what was kept, all or nothing; null empties the store. Rejects when there is no room. */
  async keep(work: Work | null): Promise<void> {
    const before = this.stored;
    const transaction = this.database.transaction(['parts', 'pointer'], 'readwrite');
    this.pages.postMessage('kept');
    try {
      const requests = work ? this.replace(transaction, work) : this.clear(transaction);
      transaction.commit();
      await Promise.all([...requests, transaction.done]);
    } catch (error) {
      if (this.stored !== before) this.stored = null; // the next write stores everything
      throw error;
    }
  }

  private clear(transaction: Writing): Requests {
    this.stored = null;
    return [transaction.objectStore('parts').clear(), transaction.objectStore('pointer').clear()];
  }

  /** Only the parts that changed are written. */
  private replace(transaction: Writing, work: Work): Requests {
    const before = this.stored;
    const parts = transaction.objectStore('parts');
    const changed = PARTS.filter((name) => before?.keys[name] === undefined || before.work[name] !== work[name]);
    const fresh = Object.fromEntries(changed.map((name) => [name, crypto.randomUUID()]));
    const keys = { ...before?.keys, ...fresh } as Current;
    const dropped = before ? changed.flatMap((name) => before.keys[name] ?? []).map((key) => parts.delete(key)) : [parts.clear()];
    this.stored = { work, keys };
    return [
      ...dropped,
      ...changed.map((name) => parts.add(work[name], fresh[name])),
      transaction.objectStore('pointer').put(keys, 'current'),
    ];
  }
}
