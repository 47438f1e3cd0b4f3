/** What an export plays: the layers shown, the pose they stand in and the track on top of it. */
import type { Landmarks, Pose, Scene, Track } from '../api/schema';
import type { Rig } from '../rig/rig';
import type { Cue } from '../speech/captions';
import { isAtRest } from '../store/edit';
import { framesOf, posesOf } from '../timeline/bakedKeys';
import { keyframesOf } from '../timeline/keyframes';
import { mixed } from '../timeline/mixing';
import { poseAt } from '../timeline/track';
import type { LayerLooks } from './layerLooks';

/** All that is needed to play, as plain data. */
export type Score = {
  readonly name: string;
  /** Only the layers that are shown. */
  readonly scene: Scene;
  readonly landmarks: Landmarks;
  readonly layers: LayerLooks;
  readonly pose: Pose;
  readonly track: Track;
  /** What it says. */
  readonly captions: readonly Cue[];
};

/** A score with its scene rigged. */
export type Performance = Score & {
  readonly rig: Rig;
  /** What the track speaks with. */
  readonly sound: AudioBuffer | null;
};

export function verticesAt({ rig, pose, track }: Pick<Performance, 'rig' | 'pose' | 'track'>, timeSeconds: number): Float64Array {
  return rig.vertices(mixed(pose, poseAt(track, timeSeconds))).vertices;
}

export function frameCount({ track }: Score, fps: number): number {
  return Math.max(1, Math.round(track.duration * fps));
}

/** The track with its keyframes and the standing pose in every frame, for the server, which knows frames only. */
export function bakedTrack({ pose, track }: Pick<Performance, 'pose' | 'track'>): Track {
  if (isAtRest(pose) && keyframesOf(track).length === 0) return track;
  return { ...track, ...framesOf(posesOf(track).map((playing) => mixed(pose, playing))) };
}
