/** Checks a project document field by field and fills in what older files left out. */
import type { Landmarks, LinearFill, LocalPath, Pose, Project, Scene, ScenePath, SolidFill } from '../api/schema';
import { N_LANDMARKS } from '../face/ibug';
import { FileError } from '../store/notices';
import { trackOf } from '../timeline/readTrack';

const HEX = /^#[0-9a-f]{6}$/;
const PARTS: readonly string[] = [
  'left_eye',
  'right_eye',
  'left_iris',
  'right_iris',
  'mouth_cavity',
  'mouth_lower',
  'tongue',
  'mouth_upper',
];

/** Throws a `FileError` that names the first field that is wrong. */
export function validProject(document: unknown, name: string): Project {
  const check: Check = (isRight, field) => {
    if (!isRight) throw new FileError(`${name} is not a valid project: ${field} is not as it should be.`);
  };
  check(isRecord(document), 'project.json');
  const given = document as Record<string, unknown>;
  check(typeof given.name === 'string', 'name');
  check(isOptionalString(given.source) && isOptionalString(given.audio), 'source or audio');
  check(given.tracks === undefined || Array.isArray(given.tracks), 'tracks');
  return {
    schema_version: 1,
    name: given.name as string,
    scene: sceneOf(given.scene, check),
    landmarks: landmarksOf(given.landmarks, check),
    pose: poseOf(given.pose, check),
    tracks: ((given.tracks as unknown[]) ?? []).map((track, index) => trackOf(track, `Track ${index + 1} of ${name}`)),
    settings: settingsOf(given.settings, check),
    source: given.source as string | null | undefined,
    audio: given.audio as string | null | undefined,
  };
}

type Check = (isRight: boolean, field: string) => void;

function sceneOf(value: unknown, check: Check): Scene {
  check(isRecord(value), 'scene');
  const scene = value as Scene;
  check(isNumber(scene.width) && scene.width > 0 && isNumber(scene.height) && scene.height > 0, 'the size of the scene');
  check(typeof scene.canvas === 'string' && HEX.test(scene.canvas), 'the canvas colour');
  for (const layer of ['back', 'fore', 'local'] as const)
    check(Array.isArray(scene[layer]) && scene[layer].every(isPath), `layer ${layer}`);
  check(
    scene.local.every(({ part }: LocalPath) => PARTS.includes(part)),
    'a part of layer local',
  );
  return scene;
}

function isPath(value: unknown): value is ScenePath {
  if (!isRecord(value) || !isRecord(value.fill)) return false;
  const { points, fill } = value;
  return Array.isArray(points) && points.length >= 12 && points.length % 6 === 0 && points.every(isNumber) && isFill(fill);
}

function isFill(value: Record<string, unknown>): boolean {
  const fill = value as unknown as SolidFill | LinearFill;
  if (fill.kind === 'solid') return isColour(fill);
  return (
    fill.kind === 'linear' &&
    isXy(fill.start) &&
    isXy(fill.end) &&
    Array.isArray(fill.stops) &&
    (fill.stops.length === 2 || fill.stops.length === 3) &&
    fill.stops.every(isColour)
  );
}

const isColour = ({ colour, opacity }: { colour: unknown; opacity: unknown }) =>
  typeof colour === 'string' && HEX.test(colour) && isNumber(opacity) && opacity >= 0 && opacity <= 1;

function landmarksOf(value: unknown, check: Check): Landmarks | null {
  if (value === null || value === undefined) return null;
  const { points, irises, depth } = value as Landmarks;
  check(Array.isArray(points) && points.length === N_LANDMARKS && points.every(isXy), 'landmarks');
  check(!irises || (irises.length === 2 && irises.every(({ centre, radius }) => isXy(centre) && isNumber(radius))), 'irises');
  check(!depth || (depth.length === N_LANDMARKS && depth.every(isNumber)), 'depth');
  return { points, irises, depth };
}

function poseOf(value: unknown, check: Check): Pose {
  if (value === undefined || value === null) return { articulators: {}, offsets: null };
  const { articulators = {}, offsets } = value as Pose;
  check(isRecord(articulators) && Object.values(articulators).every(isNumber), 'the pose');
  check(!offsets || (offsets.length === N_LANDMARKS && offsets.every(isXy)), 'the offsets of the pose');
  return { articulators, offsets: offsets ?? null };
}

function settingsOf(value: unknown, check: Check): Project['settings'] {
  check(value === undefined || isRecord(value), 'settings');
  return (value as Project['settings'] | undefined) ?? {};
}

const isXy = (value: unknown): value is [number, number] => Array.isArray(value) && value.length === 2 && value.every(isNumber);
const isNumber = (value: unknown): value is number => typeof value === 'number' && Number.isFinite(value);
const isRecord = (value: unknown): value is Record<string, unknown> => typeof value === 'object' && value !== null && !Array.isArray(value);
const isOptionalString = (value: unknown) => value === undefined || value === null || typeof value === 'string';
