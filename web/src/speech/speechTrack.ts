/** What a track of speech carries beside its channels: its blocks, how they were found, its sound, and the choices it was made with. */
import type { SpeechOptions, Track, VisemeBlock } from '../api/schema';
import type { Blocks } from './blocks';
import { isViseme } from './visemes';

/** How well the lips can be read: `rough` follows the loudness only. */
export type Tier = 'rough' | 'audio' | 'transcript' | 'edited';

export type Choices = { readonly transcript: string; readonly options: SpeechOptions };

export const STANDARD_CHOICES: Choices = {
  transcript: '',
  options: { language: 'en', style: 'normal', amplitude: 1, smoothing: 1, seed: 0, gains: {} },
};

export type SpeechTrack = Track & {
  readonly visemes?: VisemeBlock[];
  readonly tier?: Tier;
  /** File name of its sound among the project's clips. */
  readonly audio?: string;
  /** In nats, 50 a second: what moves head and brows. */
  readonly loudness?: number[];
  readonly choices?: Choices;
};

/** The blocks of a track that has any; what is not as it should be counts as none. */
export function blocksOf(track: Track | null): Blocks | null {
  const { visemes } = (track ?? {}) as SpeechTrack;
  return Array.isArray(visemes) && visemes.every(isBlock) ? visemes : null;
}

export function audioOf(track: Track | null): string | null {
  const { audio } = (track ?? {}) as SpeechTrack;
  return typeof audio === 'string' ? audio : null;
}

export function choicesOf(track: Track | null): Choices | null {
  const { choices } = (track ?? {}) as SpeechTrack;
  if (typeof choices?.transcript !== 'string' || typeof choices.options !== 'object') return null;
  return { transcript: choices.transcript, options: { ...STANDARD_CHOICES.options, ...choices.options } };
}

export function loudnessOf(track: Track | null): number[] | null {
  const { loudness } = (track ?? {}) as SpeechTrack;
  return Array.isArray(loudness) && loudness.every((value) => typeof value === 'number') ? loudness : null;
}

export function tierOf(track: Track | null): Tier | null {
  return ((track ?? {}) as SpeechTrack).tier ?? null;
}

function isBlock(value: unknown): value is VisemeBlock {
  const { t, d, viseme, weight } = (value ?? {}) as VisemeBlock;
  return [t, d, weight].every(Number.isFinite) && t >= 0 && d > 0 && isViseme(viseme);
}
