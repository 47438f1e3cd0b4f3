/** The portraits that ship with the editor. */
import { signal } from '@preact/signals';

export type Sample = { readonly file: string; readonly label: string; readonly style: string };

export const samples = signal<readonly Sample[]>([]);

/** Asks for the list once; without it, the first screen shows no samples. */
export async function loadSamples(): Promise<void> {
  const response = await fetch('samples/index.json');
  if (response.ok) samples.value = (await response.json()) as Sample[];
}
