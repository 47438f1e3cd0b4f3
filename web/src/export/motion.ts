/** What an export plays: a rigged scene, the pose it stands in and the track on top of it. */
import type { Landmarks, Pose, Scene, Track } from '../api/schema';
import { N_LANDMARKS } from '../face/ibug';
import type { Rig } from '../rig/rig';
import { isAtRest } from '../store/edit';
import { mixed, poseAt } from '../timeline/track';

export type Performance = {
  readonly name: string;
  readonly scene: Scene;
  readonly landmarks: Landmarks;
  readonly rig: Rig;
  readonly pose: Pose;
  readonly track: Track;
  /** What the track speaks with. */
  readonly sound: AudioBuffer | null;
};

export function verticesAt({ rig, pose, track }: Performance, timeSeconds: number): Float64Array {
  return rig.vertices(mixed(pose, poseAt(track, timeSeconds))).vertices;
}

export function frameCount({ track }: Performance, fps: number): number {
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
