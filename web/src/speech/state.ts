/** What the speech panel and its strip of the timeline show beside the document. Only the actions beside it write these signals. */
import { computed, effect, signal } from '@preact/signals';
import type { Span, SpeechRequest } from '../api/schema';
import { track } from '../store/state';
import type { Blocks } from './blocks';
import { captionsOf } from './captions';
import { blocksOf, type Choices, choicesOf, STANDARD_CHOICES } from './speechTrack';

export type Listening =
  | { readonly kind: 'idle' }
  | { readonly kind: 'opening'; readonly label: string }
  | { readonly kind: 'sending' }
  | { readonly kind: 'listening'; readonly stage: string; readonly progress: number };

export const listening = signal<Listening>({ kind: 'idle' });

/** What the server has been asked to listen to for a track; kept, so that it goes on after a reload. */
export type Hearing = {
  readonly trackName: string;
  readonly what: Pick<SpeechRequest, 'part' | 'visemes'> & { readonly transcript: string };
  readonly choices: Choices;
  /** Null until the server has taken it. */
  readonly jobId: string | null;
};
export const hearing = signal<Hearing | null>(null);

/** Typed, to be spoken by the server. */
export const textToSpeak = signal('');
/** How the next track is made; that of the track on the timeline, where it tells. */
export const choices = signal<Choices>(STANDARD_CHOICES);

/** Blocks of an edit whose track is still being made. */
export const pendingBlocks = signal<Blocks | null>(null);
export const blocks = computed<Blocks | null>(() => pendingBlocks.value ?? blocksOf(track.value));
export const captions = computed(() => captionsOf(track.value));
export const selectedIndex = signal<number | null>(null);
/** Dragged out on the waveform, to be listened to again. */
export const selectedSpan = signal<Readonly<Span> | null>(null);

/** What was chosen meanwhile outlasts a track that was asked for before. */
export function keepingChoices(change: () => void): void {
  const chosen = choices.value;
  change();
  choices.value = chosen;
}

/** Lets the panel show the choices that the track on the timeline was made with, after undo and reopening too. */
export function followChoices(): void {
  const kept = computed(() => choicesOf(track.value));
  effect(() => {
    if (kept.value) choices.value = kept.value;
  });
}
