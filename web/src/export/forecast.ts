/** Foretells the size and the time of a video from a few of its frames. */
import { frameCount, type Performance } from './motion';
import { SOUND_BYTES_PER_SECOND } from './soundTrack';
import { encodeFrames, type VideoOptions } from './videoFile';

export type Forecast = { readonly bytes: number; readonly seconds: number };

const SAMPLED_FRAMES = 12;

/** Encodes a few frames from the middle of the track, and reckons its sound. */
export async function forecastVideo(performance: Performance, options: VideoOptions, signal: AbortSignal): Promise<Forecast> {
  const start = now();
  const count = frameCount(performance, options.fps);
  const from = Math.floor(Math.max(0, count - SAMPLED_FRAMES) / 2);
  const to = Math.min(count, from + SAMPLED_FRAMES);
  const sample = await encodeFrames({ ...performance, sound: null, captions: [] }, options, { from, to }, signal, () => {});
  const scale = count / (to - from);
  const soundBytes = performance.sound ? SOUND_BYTES_PER_SECOND * performance.track.duration : 0;
  return { bytes: sample.size * scale + soundBytes, seconds: (now() - start) * scale };
}

/** `about 1.4 MB, 3 s`. */
export function forecastText({ bytes, seconds }: Forecast): string {
  return `about ${sizeText(bytes)}, ${seconds < 1 ? 'under a second' : `${Math.round(seconds)} s`}`;
}

/** `1.4 MB`, `320 kB`. */
export const sizeText = (bytes: number): string =>
  bytes < 1e6 ? `${Math.max(1, Math.round(bytes / 1000))} kB` : `${(bytes / 1e6).toFixed(1)} MB`;

const now = () => globalThis.performance.now() / 1000;
