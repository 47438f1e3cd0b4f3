/** The tracks that ship with the editor. */
import { signal } from '@preact/signals';

export type SampleTrack = { readonly file: string; readonly label: string };

export const sampleTracks = signal<readonly SampleTrack[]>([]);

/** Asks for the list once; without it, the demo and files still play. */
export async function loadSampleTracks(): Promise<void> {
  const response = await fetch('tracks/index.json');
  if (response.ok) sampleTracks.value = (await response.json()) as SampleTrack[];
}
