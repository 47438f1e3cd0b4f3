/** What an export plays: the layers shown, the pose they stand in and the track on top of it. */
import type { Landmarks, Pose, Scene, Track } from '../api/schema';
import { N_LANDMARKS } from '../face/ibug';
import type { Rig } from '../rig/rig';
import { isAtRest } from '../store/edit';
import { mixed, poseAt } from '../timeline/track';
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

/** The track with the standing pose added to every frame, for the server, which knows tracks only. */
export function bakedTrack({ pose, track }: Pick<Performance, 'pose' | 'track'>): Track {
  if (isAtRest(pose)) return track;
  const count = Math.max(1, Math.round(track.duration * track.fps));
  const poses = Array.from({ length: count }, (_, frame) => mixed(pose, poseAt(track, frame / track.fps)));
  const names = new Set(poses.flatMap(({ articulators }) => Object.keys(articulators)));
  const articulators = Object.fromEntries([...names].map((name) => [name, poses.map((at) => at.articulators[name] ?? 0)]));
  const still = Array.from({ length: N_LANDMARKS }, (): [number, number] => [0, 0]);
  return { ...track, articulators, landmarks: poses.map(({ offsets }) => offsets ?? still) };
}
