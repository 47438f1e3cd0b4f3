/** Reads landmark tracks and samples them: the pose of a track at an instant. */
import type { Pose, Track } from '../api/schema';
import { clampChannel } from '../face/channels';
import { N_LANDMARKS } from '../face/ibug';
import { add, type Xy } from '../face/vector';
import { offsetsOf } from '../store/edit';

/** The track's pose at `timeSeconds`, linear between frames, held at both ends. Landmarks are offsets from a neutral face. */
export function poseAt(track: Track, timeSeconds: number): Pose {
  const frame = timeSeconds * track.fps;
  const channels = Object.entries(track.articulators ?? {}).map(([name, values]) => [name, valueAt(values, frame)] as const);
  const articulators = Object.fromEntries(channels);
  if (!track.landmarks?.length) return { articulators, offsets: null };
  return { articulators: { neutral: 1, ...articulators }, offsets: offsetsAt(track.landmarks, frame) };
}

/** Two poses on top of each other; articulators stay within their ranges. */
export function mixed(a: Pose, b: Pose): Pose {
  const names = new Set([...Object.keys(a.articulators), ...Object.keys(b.articulators)]);
  const articulators = [...names].map(
    (name) => [name, clampChannel(name, (a.articulators[name] ?? 0) + (b.articulators[name] ?? 0))] as const,
  );
  const offsets = a.offsets && b.offsets ? sums(offsetsOf(a), offsetsOf(b)) : (a.offsets ?? b.offsets);
  return { articulators: Object.fromEntries(articulators), offsets };
}

/** The pose on the stage: the set one, and the track's on top while the playhead is inside it. */
export function posedBy(pose: Pose, track: Track | null, timeSeconds: number): Pose {
  return track && timeSeconds > 0 ? mixed(pose, poseAt(track, timeSeconds)) : pose;
}

function valueAt(values: readonly number[], frame: number): number {
  const [before, after, share] = neighbours(values.length, frame);
  return values.length === 0 ? 0 : values[before] + (values[after] - values[before]) * share;
}

function offsetsAt(frames: readonly Xy[][], frame: number): Xy[] {
  const [before, after, share] = neighbours(frames.length, frame);
  return Array.from({ length: N_LANDMARKS }, (_, index): Xy => {
    const a = frames[before][index];
    const b = frames[after][index];
    return [a[0] + (b[0] - a[0]) * share, a[1] + (b[1] - a[1]) * share];
  });
}

/** Frame indices before and after, and the share of the way between them. */
function neighbours(count: number, frame: number): readonly [number, number, number] {
  const last = count - 1;
  const within = Math.min(Math.max(frame, 0), Math.max(last, 0));
  const before = Math.floor(within);
  return [before, Math.min(before + 1, last), within - before];
}

const sums = (a: readonly Xy[], b: readonly Xy[]): Xy[] => a.map((offset, index) => add(offset, b[index]));
