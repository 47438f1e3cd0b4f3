/** Keyframes in files: baked into the frames, for programs that know none, with the frames as they were beside them. */
import type { Pose, Track } from '../api/schema';
import { N_LANDMARKS } from '../face/ibug';
import { keyframesOf } from './keyframes';
import { poseAt } from './track';

type Frames = Pick<Track, 'articulators' | 'landmarks'>;
type BakedTrack = Track & { readonly unkeyed?: Frames };

/** The track as files hold it. */
export function withKeysBaked(track: Track): Track {
  if (keyframesOf(track).length === 0) return track;
  const { articulators, landmarks } = track;
  return { ...track, ...framesOf(posesOf(track)), unkeyed: { articulators, landmarks } } as BakedTrack;
}

/** Undoes `withKeysBaked`. */
export function withKeysLifted(track: Track): Track {
  const { unkeyed, ...rest } = track as BakedTrack;
  return unkeyed && typeof unkeyed === 'object' ? { ...rest, ...unkeyed } : track;
}

/** The pose of every frame. */
export function posesOf(track: Track): Pose[] {
  const count = Math.max(1, Math.round(track.duration * track.fps));
  return Array.from({ length: count }, (_, frame) => poseAt(track, frame / track.fps));
}

/** Frames of a track that gives these poses. `neutral` is always said: where there are landmarks, tracks imply it. */
export function framesOf(poses: readonly Pose[]): Frames {
  const names = new Set(['neutral', ...poses.flatMap(({ articulators }) => Object.keys(articulators))]);
  const still = Array.from({ length: N_LANDMARKS }, (): [number, number] => [0, 0]);
  return {
    articulators: Object.fromEntries([...names].map((name) => [name, poses.map(({ articulators }) => articulators[name] ?? 0)])),
    landmarks: poses.some(({ offsets }) => offsets) ? poses.map(({ offsets }) => offsets ?? still) : null,
  };
}
