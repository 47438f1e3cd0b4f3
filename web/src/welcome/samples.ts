/** The portraits that ship with the editor. */
import { signal } from '@preact/signals';

/** `credit` and `licence` are shown with the picture. */
export type Sample = {
  readonly file: string;
  readonly name: string;
  readonly style: string;
  readonly credit: string;
  readonly licence: string;
};

export const samples = signal<readonly Sample[]>([]);

/** Asks for the list once; without it, the first screen shows no samples. */
export async function loadSamples(): Promise<void> {
  const response = await fetch('samples/index.json');
  if (response.ok) samples.value = (await response.json()) as Sample[];
}
