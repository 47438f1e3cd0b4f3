/** Reads a track file: JSON of articulators or landmarks, or raw 68-point rows. Told apart by content, like the server does. */
import type { Track } from '../api/schema';
import { N_LANDMARKS } from '../face/ibug';
import { FileError } from '../store/notices';
import { readPointsCsv } from './pointsCsv';

const SCHEMA_VERSION = 1;
const MAX_BYTES = 32_000_000;
const MAX_SECONDS = 3600;
const MAX_FPS = 240;

export async function readTrackFile(file: Blob, name: string): Promise<Track> {
  if (file.size > MAX_BYTES)
    throw new FileError(`${name} has ${Math.round(file.size / 1e6)} MB; the limit is ${MAX_BYTES / 1e6} MB. Cut or thin it.`);
  return readTrack(await file.text(), name);
}

/** Throws a `FileError` that names what is wrong. */
export function readTrack(text: string, name: string): Track {
  const trimmed = text.replace(/^\uFEFF/, '').trimStart();
  return trimmed.startsWith('{') || trimmed.startsWith('[') ? trackOf(parsed(trimmed, name), name) : readPointsCsv(trimmed, name);
}

function parsed(text: string, name: string): unknown {
  try {
    return JSON.parse(text) as unknown;
  } catch (reason) {
    throw new FileError(`${name} is no valid JSON: ${reason instanceof Error ? reason.message : reason}`);
  }
}

/** Checks a document field by field; what stands beside the known fields is kept. */
export function trackOf(document: unknown, name: string): Track {
  if (!isRecord(document))
    throw new FileError(`${name} is no track: a track is an object with duration, fps and landmarks or articulators.`);
  checkVersion(document.schema_version, name);
  const { duration, fps, landmarks, articulators } = document;
  if (!isNumber(duration) || duration <= 0 || duration > MAX_SECONDS)
    throw new FileError(`The duration of ${name} must be above 0 and at most ${MAX_SECONDS} seconds.`);
  if (!isNumber(fps) || fps <= 0 || fps > MAX_FPS) throw new FileError(`The fps of ${name} must be above 0 and at most ${MAX_FPS}.`);
  if (landmarks == null && articulators == null) throw new FileError(`${name} has neither landmarks nor articulators.`);
  if (landmarks != null && !isLandmarkFrames(landmarks))
    throw new FileError(`The landmarks of ${name} must be frames of ${N_LANDMARKS} pairs of numbers.`);
  if (articulators != null && !isChannels(articulators)) throw new FileError(`The articulators of ${name} must be lists of numbers.`);
  return {
    ...document,
    schema_version: SCHEMA_VERSION,
    name: typeof document.name === 'string' ? document.name : name,
    duration,
    fps,
    landmarks,
    articulators,
  };
}

function checkVersion(version: unknown, name: string): void {
  if (!isNumber(version) || version < 1) throw new FileError(`${name} has no valid schema_version.`);
  if (version > SCHEMA_VERSION) throw new FileError(`${name} is of track version ${version}; this editor reads up to ${SCHEMA_VERSION}.`);
}

function isLandmarkFrames(value: unknown): value is [number, number][][] {
  return (
    Array.isArray(value) &&
    value.length > 0 &&
    value.every((frame) => Array.isArray(frame) && frame.length === N_LANDMARKS && frame.every(isPair))
  );
}

function isChannels(value: unknown): value is Record<string, number[]> {
  return isRecord(value) && Object.values(value).every((values) => Array.isArray(values) && values.every(isNumber));
}

const isPair = (value: unknown): value is [number, number] => Array.isArray(value) && value.length === 2 && value.every(isNumber);
const isNumber = (value: unknown): value is number => typeof value === 'number' && Number.isFinite(value);
const isRecord = (value: unknown): value is Record<string, unknown> => typeof value === 'object' && value !== null && !Array.isArray(value);
