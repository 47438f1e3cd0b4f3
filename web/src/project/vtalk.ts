/** A project becomes a `.vtalk` file (a zip of project.json, the source picture and sounds) and back. The server's project.py reads the same. */
import { strFromU8, strToU8, type Unzipped, unzip, type Zippable, zip } from 'fflate';
import type { Project } from '../api/schema';
import { audioOf } from '../speech/speechTrack';
import { FileError } from '../store/notices';
import { validProject } from './validation';

const DOCUMENT = 'project.json';
const SCHEMA_VERSION = 1;
const MAX_FILE_BYTES = 128_000_000;
const MAX_ENTRY_BYTES = 64_000_000;
const FIXED_DATE = new Date(1980, 0, 1); // same project, same bytes

/** The document, the bytes of `project.source`, and by name those of `project.audio` and of the sounds that tracks name. */
export type ProjectFile = {
  readonly project: Project;
  readonly source: Uint8Array | null;
  readonly sounds: ReadonlyMap<string, Uint8Array>;
};

export function pack({ project, source, sounds }: ProjectFile): Promise<Uint8Array> {
  const entries: Zippable = { [DOCUMENT]: [strToU8(JSON.stringify(project)), { level: 6 }] };
  const stored = (data: Uint8Array) => [data, { level: 0 }] as const satisfies Zippable[string]; // media are compressed already
  if (project.source && source) entries[project.source] = stored(source);
  for (const [name, data] of sounds) entries[name] = stored(data);
  return new Promise((resolve, reject) => zip(entries, { mtime: FIXED_DATE }, (error, data) => (error ? reject(error) : resolve(data))));
}

/** Throws a `FileError` for what is no project, damaged, too large, or of a newer version. */
export async function unpack(data: Uint8Array, name: string): Promise<ProjectFile> {
  if (data.length > MAX_FILE_BYTES)
    throw new FileError(`${name} has ${megabytes(data.length)} MB; the limit is ${megabytes(MAX_FILE_BYTES)} MB.`);
  const entries = await entriesOf(data, name);
  const document = entries[DOCUMENT];
  if (!document) throw new FileError(`${name} is no project file: it holds no ${DOCUMENT}.`);
  const project = projectOf(strFromU8(document), name);
  const spoken = project.tracks.map(audioOf).flatMap((entry) => (entry !== null && entry in entries ? [entry] : [])); // tracks come from elsewhere, too
  const named = new Set([...(project.audio ? [project.audio] : []), ...spoken]);
  const sounds = new Map([...named].map((entry) => [entry, media(entries, entry, name)] as const));
  return { project, source: project.source ? media(entries, project.source, name) : null, sounds };
}

function entriesOf(data: Uint8Array, name: string): Promise<Unzipped> {
  let tooLarge: string | null = null;
  const filter = (entry: { name: string; originalSize: number }) => {
    if (entry.originalSize > MAX_ENTRY_BYTES) tooLarge = entry.name;
    return entry.originalSize <= MAX_ENTRY_BYTES;
  };
  return new Promise((resolve, reject) => {
    unzip(data, { filter }, (error, entries) => {
      if (error) reject(new FileError(`${name} is not a whole project file (${error.message}): save it again.`));
      else if (tooLarge)
        reject(new FileError(`${tooLarge} of ${name} has more than ${megabytes(MAX_ENTRY_BYTES)} MB, which is the limit.`));
      else resolve(entries);
    });
  });
}

function projectOf(text: string, name: string): Project {
  const document = parsed(text, name);
  const version = (document as { schema_version?: unknown } | null)?.schema_version;
  if (typeof version !== 'number' || version < 1) throw new FileError(`${name} has no valid schema_version.`);
  if (version > SCHEMA_VERSION)
    throw new FileError(
      `${name} was saved by a newer VectorTalker (project version ${version}; this one reads up to ${SCHEMA_VERSION}): update VectorTalker.`,
    );
  return validProject(document, name);
}

function parsed(text: string, name: string): unknown {
  try {
    return JSON.parse(text) as unknown;
  } catch {
    throw new FileError(`${DOCUMENT} of ${name} is no valid JSON: save the project again.`);
  }
}

function media(entries: Unzipped, entry: string, name: string): Uint8Array {
  const data = entries[entry];
  if (!data) throw new FileError(`${name} holds no ${entry}: save the project again.`);
  return data;
}

const megabytes = (bytes: number) => Math.round(bytes / 1e6);
