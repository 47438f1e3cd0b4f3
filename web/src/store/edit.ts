/** The editable document, immutable, and the pure edits of it. The scene is no part of it: finer ones replace it under the edits. */
import type { Landmarks, Pose, Track } from '../api/schema';
import { CHANNEL_GROUPS, clampChannel } from '../face/channels';
import { N_LANDMARKS } from '../face/ibug';
import { add, type Xy } from '../face/vector';

export type Articulators = Readonly<Record<string, number>>;
export type LayerName = 'back' | 'fore' | 'local';
export const LAYER_NAMES: readonly LayerName[] = ['back', 'fore', 'local'];

export type LayerLook = { readonly visible: boolean; readonly opacity: number };

export type Edit = {
  readonly name: string;
  /** Rest landmarks in portrait pixels; null while the portrait has no face. */
  readonly landmarks: Landmarks | null;
  readonly pose: Pose;
  readonly layers: Readonly<Record<LayerName, LayerLook>>;
  /** Opened tracks; the first one is on the timeline. */
  readonly tracks: readonly Track[];
};

const SHOWN: LayerLook = { visible: true, opacity: 1 };

export const REST_POSE: Pose = { articulators: {}, offsets: null };

export function editOf(name: string, landmarks: Landmarks | null): Edit {
  return { name, landmarks, pose: REST_POSE, layers: { back: SHOWN, fore: SHOWN, local: SHOWN }, tracks: [] };
}

export function withArticulators(edit: Edit, articulators: Articulators): Edit {
  return { ...edit, pose: { ...edit.pose, articulators: nonZero(articulators) } };
}

/** One channel set, within its range. */
export function withChannel(edit: Edit, name: string, value: number): Edit {
  return withArticulators(edit, { ...edit.pose.articulators, [name]: clampChannel(name, value) });
}

export function withoutChannels(edit: Edit, names: readonly string[]): Edit {
  const kept = Object.entries(edit.pose.articulators).filter(([name]) => !names.includes(name));
  return kept.length === Object.keys(edit.pose.articulators).length ? edit : withArticulators(edit, Object.fromEntries(kept));
}

/** All channels of one group of the pose panel back at rest. */
export function withoutGroup(edit: Edit, groupName: string): Edit {
  const group = CHANNEL_GROUPS.find(({ name }) => name === groupName);
  return group
    ? withoutChannels(
        edit,
        group.channels.map(({ name }) => name),
      )
    : edit;
}

/** Offsets increased by `displacements` (68 × [dx, dy], in outer-eye distances). */
export function withOffsetsAdded(edit: Edit, displacements: readonly Xy[]): Edit {
  const offsets = offsetsOf(edit.pose).map((offset, index) => add(offset, displacements[index]));
  return { ...edit, pose: { ...edit.pose, offsets } };
}

/** The offsets of these landmarks back at zero. */
export function withoutOffsets(edit: Edit, indices: readonly number[]): Edit {
  const offsets = offsetsOf(edit.pose);
  if (indices.every((index) => offsets[index][0] === 0 && offsets[index][1] === 0)) return edit;
  const kept = offsets.map((offset, index): Xy => (indices.includes(index) ? [0, 0] : offset));
  const moved = kept.some(([dx, dy]) => dx !== 0 || dy !== 0);
  return { ...edit, pose: { ...edit.pose, offsets: moved ? kept : null } };
}

export function atRest(edit: Edit): Edit {
  return isAtRest(edit.pose) ? edit : { ...edit, pose: REST_POSE };
}

export function isAtRest(pose: Pose): boolean {
  return !pose.offsets && Object.keys(pose.articulators).length === 0;
}

export function withLandmarks(edit: Edit, landmarks: Landmarks | null): Edit {
  return { ...edit, landmarks };
}

/** Whether both name the same points; stored copies are other objects. */
export function areSameLandmarks(a: Landmarks | null, b: Landmarks | null): boolean {
  if (a === b || !a || !b) return a === b;
  return a.points.every(([x, y], index) => x === b.points[index][0] && y === b.points[index][1]);
}

export function withLayer(edit: Edit, name: LayerName, look: LayerLook): Edit {
  return { ...edit, layers: { ...edit.layers, [name]: look } };
}

/** Puts `track` on the timeline; the other opened tracks stay at hand. */
export function withTrack(edit: Edit, track: Track): Edit {
  return { ...edit, tracks: [track, ...edit.tracks.filter((other) => other !== track && other.name !== track.name)] };
}

/** `next` where `old` was; the same document where it is no more. */
export function withTrackReplaced(edit: Edit, old: Track, next: Track): Edit {
  return edit.tracks.includes(old) ? { ...edit, tracks: edit.tracks.map((track) => (track === old ? next : track)) } : edit;
}

/** 68 offsets, zeros where the pose has none. */
export function offsetsOf(pose: Pose): Xy[] {
  return pose.offsets ?? Array.from({ length: N_LANDMARKS }, (): Xy => [0, 0]);
}

const nonZero = (articulators: Articulators): Record<string, number> =>
  Object.fromEntries(Object.entries(articulators).filter(([, value]) => value !== 0));
