/** Actions on tracks: put one on the timeline, open a file or a sample. */
import type { Track } from '../api/schema';
import { play, rewind } from '../timeline/playback';
import { readTrack, readTrackFile } from '../timeline/readTrack';
import { withTrack } from './edit';
import { apply } from './editing';
import { announce, FileError } from './notices';

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
