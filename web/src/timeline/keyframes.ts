/** Keyframes that people set on a track: poses on top of what the track does by itself, eased from one to the next. */
import type { Pose, Track } from '../api/schema';
import { N_LANDMARKS } from '../face/ibug';
import { mixed } from './mixing';

/** `t` in seconds, on a frame of the track. */
export type Keyframe = { readonly t: number; readonly pose: Pose };

type KeyedTrack = Track & { readonly keyframes?: readonly Keyframe[] };

const NO_POSE: Pose = { articulators: {}, offsets: null };

/** In order of time; what is not as it should be counts as none. */
export function keyframesOf(track: Track): readonly Keyframe[] {
  const { keyframes } = track as KeyedTrack;
  return Array.isArray(keyframes) && keyframes.every(isKeyframe) ? keyframes : [];
}

/** Adds `pose` to what the keyframes give at `seconds`, as the keyframe of that frame. */
export function withKeyframe(track: Track, seconds: number, pose: Pose): Track {
  const t = Math.round(seconds * track.fps) / track.fps;
  const keyframes = keyframesOf(track);
  const others = keyframes.filter((keyframe) => keyframe.t !== t);
  const added = { t, pose: mixed(keyedPose(keyframes, t), pose) };
  return { ...track, keyframes: [...others, added].sort((a, b) => a.t - b.t) } as KeyedTrack;
}

export function withoutKeyframe(track: Track, t: number): Track {
  return { ...track, keyframes: keyframesOf(track).filter((keyframe) => keyframe.t !== t) } as KeyedTrack;
}

/** The pose of the keyframes alone: along a cosine between two, held before the first and after the last. */
export function keyedPose(keyframes: readonly Keyframe[], seconds: number): Pose {
  const after = keyframes.findIndex(({ t }) => t > seconds);
  if (after <= 0) return (after === 0 ? keyframes[0] : keyframes.at(-1))?.pose ?? NO_POSE;
  const [from, to] = [keyframes[after - 1], keyframes[after]];
  const share = (1 - Math.cos((Math.PI * (seconds - from.t)) / (to.t - from.t))) / 2;
  return mixed(scaled(from.pose, 1 - share), scaled(to.pose, share));
}

function scaled({ articulators, offsets }: Pose, factor: number): Pose {
  return {
    articulators: Object.fromEntries(Object.entries(articulators).map(([name, value]) => [name, value * factor])),
    offsets: offsets?.map(([dx, dy]): [number, number] => [dx * factor, dy * factor]) ?? null,
  };
}

function isKeyframe(value: unknown): value is Keyframe {
  const { t, pose } = (value ?? {}) as Keyframe;
  const isPose = typeof pose?.articulators === 'object' && Object.values(pose.articulators).every(Number.isFinite);
  return Number.isFinite(t) && t >= 0 && isPose && (!pose.offsets || pose.offsets.length === N_LANDMARKS);
}
