/** Actions on tracks: put one on the timeline, open a file or a sample. */
import type { Track } from '../api/schema';
import { keyframesOf, withKeyframe, withoutKeyframe } from '../timeline/keyframes';
import { pause, play, rewind } from '../timeline/playback';
import { readTrack, readTrackFile } from '../timeline/readTrack';
import { atRest, isAtRest, withTrack } from './edit';
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
  pause();
  const playhead = timeSeconds.value;
  apply((present) => atRest(withTrack(present, withKeyframe(track.value ?? EMPTY_TRACK, playhead, present.pose))));
  timeSeconds.value = Math.max(playhead, JUST_PLAYING);
  announce(`Keyframe at ${playhead.toFixed(2)} seconds`);
}

export function removeKeyframe(t: number): void {
  const open = track.value;
  if (!open || !keyframesOf(open).some((keyframe) => keyframe.t === t)) return;
  apply((present) => withTrack(present, withoutKeyframe(open, t)));
  announce(`Keyframe at ${t.toFixed(2)} seconds removed`);
}
