/**
 * Captions: what a track says, in pieces that are read at a glance, each at its time. The words have no times of their own: they
 * share the time in which the lips move by their letters, and where a piece ends near a pause it ends at that pause.
 */
import type { Track } from '../api/schema';
import { type Blocks, endOf } from './blocks';
import { blocksOf, choicesOf } from './speechTrack';

/** Seconds on the track. */
export type Cue = { readonly start: number; readonly end: number; readonly text: string };

type Span = { readonly start: number; readonly end: number };

const MAX_CHARACTERS = 74; // two lines of 37, the measure of broadcast subtitles
const COMMA_CHARACTERS = 16; // a piece may be so much longer or shorter to end at a comma
const LEAST_PAUSE = 0.12; // seconds; shorter ones are closures within a word
const SNAP_SECONDS = 0.6; // of speech: letters tell the time of a word about as well
const LINGER_SECONDS = 0.8; // a piece stays in a pause, to be read to its end

/** No cues where the words are not known. */
export function captionsOf(track: Track | null): Cue[] {
  const choices = choicesOf(track);
  if (!track || !choices) return [];
  const texts = pieces(choices.transcript);
  const spans = spokenSpans(blocksOf(track), track.duration);
  return texts.length > 0 && spans.length > 0 ? timed(texts, spans, track.duration) : [];
}

export function cueAt(cues: readonly Cue[], seconds: number): Cue | null {
  return cues.find(({ start, end }) => start <= seconds && seconds < end) ?? null;
}

/** The text of a WebVTT file (W3C, Web Video Text Tracks). */
export function webVtt(cues: readonly Cue[]): string {
  const blocks = cues.map(({ start, end, text }) => `${timestamp(start)} --> ${timestamp(end)}\n${escaped(text)}\n`);
  return ['WEBVTT\n', ...blocks].join('\n');
}

/** Sentences; long ones in pieces. */
function pieces(transcript: string): string[] {
  const text = transcript.replace(/\s+/g, ' ').trim();
  return segments(text, 'sentence').flatMap((sentence) => parted(sentence.trim()));
}

/** Pieces of whole words, about as long as each other, that end at a comma where one is near. */
function parted(sentence: string): string[] {
  if (sentence.length <= MAX_CHARACTERS) return sentence ? [sentence] : [];
  const wanted = sentence.length / Math.ceil(sentence.length / MAX_CHARACTERS);
  const words = segments(sentence, 'word');
  const ends = runningSums(words.map(({ length }) => length));
  const breaks = ends.filter((end, k) => end <= MAX_CHARACTERS && /[\p{L}\p{N}]/u.test(words[k + 1] ?? ''));
  const cost = (end: number) => Math.abs(end - wanted) - (/[,;:–—]\s*$/.test(sentence.slice(0, end)) ? COMMA_CHARACTERS : 0);
  const best = breaks.length > 0 ? breaks.reduce((a, b) => (cost(b) < cost(a) ? b : a)) : MAX_CHARACTERS;
  return [sentence.slice(0, best).trim(), ...parted(sentence.slice(best).trim())];
}

/** By the rules of Unicode, which are the same for nearly all languages; scripts without spaces are parted by dictionaries of the browser. */
function segments(text: string, granularity: 'sentence' | 'word'): string[] {
  return Array.from(new Intl.Segmenter('en', { granularity }).segment(text), ({ segment }) => segment);
}

/** Where the lips move; all of the track where nothing is known of them. */
function spokenSpans(blocks: Blocks | null, duration: number): Span[] {
  if (!blocks) return [{ start: 0, end: duration }];
  const spans: Span[] = [];
  for (const block of blocks.filter(({ viseme }) => viseme !== 'sil')) {
    const last = spans.at(-1);
    const goesOn = last && block.t - last.end < LEAST_PAUSE;
    spans.push({ start: goesOn ? last.start : block.t, end: endOf(block) });
    if (goesOn) spans.splice(-2, 1);
  }
  return spans;
}

function timed(texts: readonly string[], spans: readonly Span[], duration: number): Cue[] {
  const ends = spokenEnds(texts, spans);
  const cues = texts.map((text, k) => ({
    start: clockTime(spans, ends[k - 1] ?? 0, 'start'),
    end: clockTime(spans, ends[k], 'end'),
    text,
  }));
  return cues.map((cue, k) => ({ ...cue, end: Math.min(cue.end + LINGER_SECONDS, cues[k + 1]?.start ?? duration) }));
}

/** When each text ends, in seconds of speech alone. A text is moved to a pause by half its length at most, so that each keeps its turn. */
function spokenEnds(texts: readonly string[], spans: readonly Span[]): number[] {
  const pauses = runningSums(spans.map(({ start, end }) => end - start));
  const all = pauses[pauses.length - 1];
  const letters = texts.map((text) => Math.max(1, text.replace(/[^\p{L}\p{N}]/gu, '').length));
  const seconds = letters.map((count) => (count / letters.reduce((sum, each) => sum + each)) * all);
  let before = 0;
  return runningSums(seconds).map((expected, k) => {
    if (k === seconds.length - 1) return all;
    const reach = Math.min(SNAP_SECONDS, seconds[k] / 2, seconds[k + 1] / 2);
    const near = pauses.filter((pause) => pause > before && Math.abs(pause - expected) <= reach);
    before = near.length > 0 ? nearest(near, expected) : expected;
    return before;
  });
}

/** The track's time after `spoken` seconds of speech: before the pause that is there, or after it. */
function clockTime(spans: readonly Span[], spoken: number, side: 'start' | 'end'): number {
  const ends = runningSums(spans.map(({ start, end }) => end - start));
  const index = ends.findIndex((end) => (side === 'start' ? spoken < end : spoken <= end));
  const at = index < 0 ? spans.length - 1 : index;
  return spans[at].end - (ends[at] - spoken);
}

function runningSums(values: readonly number[]): number[] {
  let sum = 0;
  return values.map((value) => {
    sum += value;
    return sum;
  });
}

const nearest = (values: readonly number[], wanted: number) =>
  values.reduce((best, value) => (Math.abs(value - wanted) < Math.abs(best - wanted) ? value : best));

/** `00:01:02.345`. */
function timestamp(seconds: number): string {
  const milliseconds = Math.round(seconds * 1000);
  const part = (unit: number, base: number, digits: number) => `${Math.floor(milliseconds / unit) % base}`.padStart(digits, '0');
  return `${part(3_600_000, 100, 2)}:${part(60_000, 60, 2)}:${part(1000, 60, 2)}.${part(1, 1000, 3)}`;
}

const ENTITIES: Readonly<Record<string, string>> = { '&': '&amp;', '<': '&lt;', '>': '&gt;' };

const escaped = (text: string) => text.replace(/[&<>]/g, (character) => ENTITIES[character]);
