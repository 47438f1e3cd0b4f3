/** Actions on blocks and manner: each asks the server for the track of the blocks, and is one step. */
import { RequestError } from '../api/client';
import type { SpeechOptions } from '../api/schema';
import { postVisemes } from '../api/speech';
import { withTrackReplaced } from '../store/edit';
import { apply } from '../store/editing';
import { FileError, report } from '../store/notices';
import { track } from '../store/state';
import type { Blocks } from './blocks';
import { blocksOf, choicesOf, loudnessOf, type SpeechTrack } from './speechTrack';
import { blocks, choices, keepingChoices, listening, pendingBlocks } from './state';

const SETTLED_MILLISECONDS = 150;

/** Edits wait for each other, so that every one becomes a step, in order. */
let queue = Promise.resolve();
let queued = 0;
let settling: ReturnType<typeof setTimeout> | undefined;

/** Blocks as they were edited; shown at once, spoken when the server has answered. */
export function editBlocks(next: Blocks): void {
  if (next === blocks.value) return;
  pendingBlocks.value = next;
  enqueue(next, { tier: 'edited' });
}

/** A slider on its way: shown, not yet spoken. */
export function sketchChoice(next: Partial<SpeechOptions>): void {
  choices.value = { ...choices.value, options: { ...choices.value.options, ...next } };
}

/** Manner, gains, amplitude, smoothing: taken up by the track on the timeline as soon as they rest and nothing is being listened to. */
export function choose(next: Partial<SpeechOptions>): void {
  sketchChoice(next);
  clearTimeout(settling);
  settling = setTimeout(takeUpChoices, SETTLED_MILLISECONDS);
}

/** The track of the blocks on the timeline is made anew if it was made with other choices; a hearing that ends asks again. */
export function takeUpChoices(): void {
  clearTimeout(settling);
  const present = blocks.value;
  if (present && listening.value.kind === 'idle' && !isTakenUp(choices.value.options)) enqueue(present, {});
}

const isTakenUp = (options: SpeechOptions) => JSON.stringify(choicesOf(track.value)?.options) === JSON.stringify(options);

function enqueue(next: Blocks, beside: Partial<SpeechTrack>): void {
  queued += 1;
  queue = queue
    .then(() => place(next, beside))
    .catch((error: unknown) => report(isOffline(error) ? new FileError(OFFLINE) : error))
    .finally(() => {
      queued -= 1;
      if (queued === 0) pendingBlocks.value = null;
    });
}

const OFFLINE = 'The server does not answer, and it is the server that forms visemes: make this edit again when it is back.';
const isOffline = (error: unknown) => error instanceof RequestError && error.code === 'offline';

async function place(next: Blocks, beside: Partial<SpeechTrack>): Promise<void> {
  const base = track.value;
  if (!base || !blocksOf(base)) return;
  const asked = choices.value;
  const { articulators } = await postVisemes(next, base.duration, loudnessOf(base), asked.options);
  const spoken: SpeechTrack = { ...base, ...beside, articulators, landmarks: null, visemes: [...next], choices: asked };
  keepingChoices(() => apply((present) => withTrackReplaced(present, base, spoken)));
}
