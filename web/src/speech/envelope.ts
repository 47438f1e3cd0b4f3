/** Samples become what is seen of them: the loudness that opens the jaw of a first, rough track, and the peaks of a waveform. */
import type { Track } from '../api/schema';

/** Mono samples in −1…1. */
export type Samples = { readonly values: Float32Array; readonly rate: number };

const FPS = 50;
const WINDOW_SECONDS = 0.04;
const FLOOR = 0.12; // of the loud level: room noise and breath do not open the mouth
const LOUD_SHARE = 0.95; // quantile of the loudness that opens the jaw widest
const SILENT = 1e-3; // −60 dB: a clip below it has no voice
const WIDEST = 0.8;
const RELEASE = 0.6; // share of the opening left a frame later: mouths pop open and close slowly

export const secondsOf = ({ values, rate }: Samples): number => values.length / rate;

/** Root mean square round every frame, 50 a second. */
export function envelopeOf({ values, rate }: Samples): Float32Array {
  const half = Math.round((WINDOW_SECONDS / 2) * rate);
  return Float32Array.from({ length: Math.max(1, Math.round((values.length / rate) * FPS)) }, (_, frame) => {
    const middle = Math.round((frame / FPS) * rate);
    const from = Math.max(0, middle - half);
    const to = Math.min(values.length, middle + half);
    let sum = 0;
    for (let at = from; at < to; at++) sum += values[at] ** 2;
    return Math.sqrt(sum / Math.max(1, to - from));
  });
}

/** A track whose jaw opens with the loudness: something moves in time with the sound, but lips cannot be read. */
export function roughTrack(samples: Samples, name: string): Track {
  const envelope = envelopeOf(samples);
  const loud = Float32Array.from(envelope).sort()[Math.floor(LOUD_SHARE * (envelope.length - 1))];
  let opening = 0;
  const jaw = Array.from(envelope, (level) => {
    const wanted = loud < SILENT ? 0 : WIDEST * Math.min(1, Math.max(0, (level / loud - FLOOR) / (1 - FLOOR)));
    opening = Math.max(wanted, opening * RELEASE);
    return Math.round(opening * 1000) / 1000;
  });
  return {
    schema_version: 1,
    name,
    duration: envelope.length / FPS,
    fps: FPS,
    articulators: { jaw, neutral: jaw.map(() => 1) },
  };
}

/** Largest magnitude within each of `count` equal parts of `from` … `to` seconds. */
export function peaksOf({ values, rate }: Samples, from: number, to: number, count: number): Float32Array {
  const step = ((to - from) * rate) / count;
  return Float32Array.from({ length: count }, (_, part) => {
    const first = Math.max(0, Math.floor(from * rate + part * step));
    const last = Math.min(values.length, Math.ceil(from * rate + (part + 1) * step));
    let most = 0;
    for (let at = first; at < last; at++) most = Math.max(most, Math.abs(values[at]));
    return most;
  });
}
