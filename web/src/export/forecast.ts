/** Foretells the size and the time of an export from a quick sample of it. */
import type { Scene } from '../api/schema';
import { buildRig } from '../rig/rig';
import { frameCount, type Performance } from './motion';
import { SOUND_BYTES_PER_SECOND } from './soundTrack';
import { animatedSvg } from './svgFile';
import { encodeFrames, type VideoOptions } from './videoFile';

export type Forecast = { readonly bytes: number; readonly seconds: number };

const SAMPLED_PATHS = 8; // one path of so many
const SAMPLED_FRAMES = 12;

/** Writes the animated SVG of every eighth path. */
export function forecastSvg(performance: Performance): Forecast {
  const start = now();
  const sample = everyNth(performance.scene, SAMPLED_PATHS);
  const rig = buildRig(sample, performance.landmarks);
  try {
    const text = animatedSvg({ ...performance, scene: sample, rig }, { looped: true, durationSeconds: performance.track.duration });
    return { bytes: text.length * SAMPLED_PATHS, seconds: (now() - start) * SAMPLED_PATHS };
  } finally {
    rig.dispose();
  }
}

/** Encodes a few frames from the middle of the track, and reckons its sound. */
export async function forecastVideo(performance: Performance, options: VideoOptions, signal: AbortSignal): Promise<Forecast> {
  const start = now();
  const count = frameCount(performance, options.fps);
  const from = Math.floor(Math.max(0, count - SAMPLED_FRAMES) / 2);
  const to = Math.min(count, from + SAMPLED_FRAMES);
  const sample = await encodeFrames({ ...performance, sound: null }, options, { from, to }, signal, () => {});
  const scale = count / (to - from);
  const soundBytes = performance.sound ? SOUND_BYTES_PER_SECOND * performance.track.duration : 0;
  return { bytes: sample.size * scale + soundBytes, seconds: (now() - start) * scale };
}

/** `1.4 MB, about 3 s`. */
export function forecastText({ bytes, seconds }: Forecast): string {
  const size = bytes < 1e6 ? `${Math.max(1, Math.round(bytes / 1000))} kB` : `${(bytes / 1e6).toFixed(1)} MB`;
  return `about ${size}, ${seconds < 1 ? 'under a second' : `${Math.round(seconds)} s`}`;
}

function everyNth(scene: Scene, n: number): Scene {
  const kept = <T>(paths: readonly T[]) => paths.filter((_, index) => index % n === 0);
  return { ...scene, back: kept(scene.back), fore: kept(scene.fore), local: kept(scene.local) };
}

const now = () => globalThis.performance.now() / 1000;
