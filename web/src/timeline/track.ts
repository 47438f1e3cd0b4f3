/** Reads landmark tracks and samples them: the pose of a track at an instant. */
import type { Pose, Track } from '../api/schema';
import { N_LANDMARKS } from '../face/ibug';
import type { Xy } from '../face/vector';
import { keyedPose, keyframesOf } from './keyframes';
import { mixed } from './mixing';

/** The track's pose at `timeSeconds`, its keyframes included. */
export function poseAt(track: Track, timeSeconds: number): Pose {
  const keyframes = keyframesOf(track);
  const sampled = sampledPose(track, timeSeconds);
  return keyframes.length === 0 ? sampled : mixed(sampled, keyedPose(keyframes, timeSeconds));
}

/** Its frames alone, linear between them, held at both ends. Landmarks are offsets from a neutral face. */
export function sampledPose(track: Track, timeSeconds: number): Pose {
  const frame = timeSeconds * track.fps;
  const channels = Object.entries(track.articulators ?? {}).map(([name, values]) => [name, valueAt(values, frame)] as const);
  const articulators = Object.fromEntries(channels);
  if (!track.landmarks?.length) return { articulators, offsets: null };
  return { articulators: { neutral: 1, ...articulators }, offsets: offsetsAt(track.landmarks, frame) };
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
