/** Measures whether lips move in step with the sound: both are watched as the page makes them, and correlated. */
import type { Page } from '@playwright/test';

/** At `time` (milliseconds of the page): the loudness that leaves the page, and the height of the mouth's opening in the picture. */
export type Sample = { readonly time: number; readonly loudness: number; readonly opening: number };

declare global {
  interface Window {
    lipsAndSound?: Sample[];
  }
}

/** From the next page on, every frame adds a sample to `window.lipsAndSound`: the sound at its start, and the picture at its end. */
export async function watchLipsAndSound(page: Page): Promise<void> {
  await page.addInitScript(() => {
    const samples: Sample[] = [];
    window.lipsAndSound = samples;
    const connect = AudioNode.prototype.connect as (this: AudioNode, ...to: unknown[]) => AudioNode;
    const windows = new Map<BaseAudioContext, AnalyserNode>();
    AudioNode.prototype.connect = function (this: AudioNode, ...to: unknown[]) {
      if (to[0] instanceof AudioDestinationNode) {
        const analyser = windows.get(this.context) ?? this.context.createAnalyser();
        analyser.fftSize = 1024;
        windows.set(this.context, analyser);
        connect.call(this, analyser);
      }
      return connect.apply(this, to);
    } as typeof AudioNode.prototype.connect;
    const values = new Float32Array(1024);
    const loudness = () => {
      let power = 0;
      for (const analyser of windows.values()) {
        analyser.getFloatTimeDomainData(values);
        power += values.reduce((sum, value) => sum + value * value, 0) / values.length;
      }
      return Math.sqrt(power);
    };
    const opening = () => {
      const numbers =
        document
          .querySelector('#opening-mouth path')
          ?.getAttribute('d')
          ?.match(/-?\d+(\.\d+)?/g) ?? [];
      const heights = numbers.map(Number).filter((_, place) => place % 2 === 1);
      return heights.length > 0 ? Math.max(...heights) - Math.min(...heights) : 0;
    };
    const frameEnd = new MessageChannel();
    const watch = () => {
      const time = performance.now();
      const heard = loudness();
      frameEnd.port1.onmessage = () => samples.push({ time, loudness: heard, opening: opening() });
      frameEnd.port2.postMessage(null);
      requestAnimationFrame(watch);
    };
    requestAnimationFrame(watch);
  });
}

const STEP_SECONDS = 0.01;
const MOST_STEPS = 30;

/** The lag at which opening and loudness correlate best; positive when the lips come late. */
export function bestLag(samples: readonly Sample[]): { readonly lagSeconds: number; readonly correlation: number } {
  const loudness = resampled(samples, ({ loudness: value }) => value);
  const opening = resampled(samples, ({ opening: value }) => value);
  const lags = Array.from({ length: 2 * MOST_STEPS + 1 }, (_, k) => k - MOST_STEPS);
  const scored = lags.map((lag) => ({ lagSeconds: lag * STEP_SECONDS, correlation: correlation(loudness, opening, lag) }));
  return scored.reduce((best, next) => (next.correlation > best.correlation ? next : best));
}

/** Every STEP_SECONDS, linear between samples. */
function resampled(samples: readonly Sample[], read: (sample: Sample) => number): number[] {
  const start = samples[0].time;
  const count = Math.floor((samples[samples.length - 1].time - start) / (1000 * STEP_SECONDS));
  let at = 0;
  return Array.from({ length: count }, (_, step) => {
    const time = start + 1000 * STEP_SECONDS * step;
    while (samples[at + 1].time < time) at += 1;
    const [a, b] = [samples[at], samples[at + 1]];
    return read(a) + ((read(b) - read(a)) * (time - a.time)) / (b.time - a.time);
  });
}

/** Pearson's, of a[k] and b[k + lag]. */
function correlation(a: readonly number[], b: readonly number[], lag: number): number {
  const pairs = a.flatMap((value, k) => (b[k + lag] === undefined ? [] : [[value, b[k + lag]] as const]));
  const mean = (side: 0 | 1) => pairs.reduce((sum, pair) => sum + pair[side], 0) / pairs.length;
  const [meanA, meanB] = [mean(0), mean(1)];
  const sums = pairs.reduce(
    ([ab, aa, bb], [x, y]) => [ab + (x - meanA) * (y - meanB), aa + (x - meanA) ** 2, bb + (y - meanB) ** 2],
    [0, 0, 0],
  );
  return sums[0] / Math.sqrt(sums[1] * sums[2]);
}
