/** Actions on tracks: put one on the timeline, open a file or a sample. */
import type { Pose, Track } from '../api/schema';
import { keyframesOf, withKeyframe, withoutKeyframe } from '../timeline/keyframes';
import { pause, play, rewind } from '../timeline/playback';
import { readTrack, readTrackFile } from '../timeline/readTrack';
import { atRest, type Edit, isAtRest, withoutChannels, withTrack } from './edit';
import { apply } from './editing';
import { announce, FileError, tell } from './notices';
import { canPose, edit, timeSeconds, track } from './state';

export function useTrack(track: Track): void {
  rewind();
  apply((present) => withTrack(present, track));
  announce(`${track.name}, ${track.duration.toFixed(1)} seconds`);
  play();
}

export async function openTrackFile(file: File): Promise<void> {
  useTrack(await readTrackFile(file, file.name));
}

export async function openSampleTrack(file: string): Promise<void> {
  const response = await fetch(`tracks/${file}`);
  if (!response.ok) throw new FileError(`The sample track ${file} cannot be loaded.`);
  useTrack(readTrack(await response.text(), file));
}

const EMPTY_TRACK: Track = { schema_version: 1, name: 'Keyframes', duration: 4, fps: 25, articulators: { neutral: Array(100).fill(0) } };
const JUST_PLAYING = 1e-3; // seconds: at 0 a track has no effect

/** Moves the pose that was set into a keyframe at the playhead; without a track it starts one. */
export function insertKeyframe(): void {
  if (!canPose.value) return;
  if (isAtRest(edit.value.pose)) {
    tell({ kind: 'advice', text: 'Pose the portrait first: the keyframe takes the pose that is set.' });
    return;
  }
  keyAtPlayhead(edit.value.pose, atRest);
}

/** Moves one channel of the pose into a keyframe at the playhead; at rest, the channel is held there as it stands. */
export function pinChannel(name: string): void {
  if (!canPose.value) return;
  const value = edit.value.pose.articulators[name] ?? 0;
  keyAtPlayhead({ articulators: { [name]: value }, offsets: null }, (present) => withoutChannels(present, [name]));
}

function keyAtPlayhead(pose: Pose, withoutIt: (edit: Edit) => Edit): void {
  pause();
  const playhead = timeSeconds.value;
  apply((present) => withoutIt(withTrack(present, withKeyframe(track.value ?? EMPTY_TRACK, playhead, pose))));
  timeSeconds.value = Math.max(playhead, JUST_PLAYING);
  announce(`Keyframe at ${playhead.toFixed(2)} seconds`);
}

export function removeKeyframe(t: number): void {
  const open = track.value;
  if (!open || !keyframesOf(open).some((keyframe) => keyframe.t === t)) return;
  apply((present) => withTrack(present, withoutKeyframe(open, t)));
  announce(`Keyframe at ${t.toFixed(2)} seconds removed`);
}
