/** Measures whether lips move in step with the sound: both are watched as the page makes them, and correlated. */
import type { Page } from '@playwright/test';

/**
 * A frame of the page. `loudness` is that of the sound which left the page before `time`, a value every STEP_SECONDS, the latest first:
 * machines that paint seldom are heard without gaps. Seconds are the sound's own, which stand still where a busy machine lets it break off.
 * `opening` is the height of the mouth's opening in the picture.
 */
export type Frame = { readonly time: number; readonly loudness: readonly number[]; readonly opening: number };

declare global {
  interface Window {
    lipsAndSound?: Frame[];
  }
}

const STEP_SECONDS = 0.01;
const MOST_STEPS = 30;

/** From the next page on, every frame since the first sound is added to `window.lipsAndSound`: the sound at its start, and the picture at its end. */
export async function watchLipsAndSound(page: Page): Promise<void> {
  await page.addInitScript((stepSeconds) => {
    const frames: Frame[] = [];
    window.lipsAndSound = frames;
    const connect = AudioNode.prototype.connect as (this: AudioNode, ...to: unknown[]) => AudioNode;
    let heard: AnalyserNode | null = null;
    AudioNode.prototype.connect = function (this: AudioNode, ...to: unknown[]) {
      if (to[0] instanceof AudioDestinationNode) {
        heard ??= new AnalyserNode(this.context, { fftSize: 32768 });
        connect.call(this, heard);
      }
      return connect.apply(this, to);
    } as typeof AudioNode.prototype.connect;
    const loudnessOf = (analyser: AnalyserNode): number[] => {
      const values = new Float32Array(analyser.fftSize);
      analyser.getFloatTimeDomainData(values);
      const step = Math.round(stepSeconds * analyser.context.sampleRate);
      return Array.from({ length: Math.floor(values.length / step) }, (_, k) => {
        const piece = values.subarray(values.length - (k + 1) * step, values.length - k * step);
        return Math.sqrt(piece.reduce((sum, value) => sum + value * value, 0) / step);
      });
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
      requestAnimationFrame(watch);
      if (!heard) return;
      const start = { time: heard.context.currentTime, loudness: loudnessOf(heard) };
      frameEnd.port1.onmessage = () => frames.push({ ...start, opening: opening() });
      frameEnd.port2.postMessage(null);
    };
    requestAnimationFrame(watch);
  }, STEP_SECONDS);
}

/** The lag at which opening and loudness correlate best; positive when the lips come late. */
export function bestLag(frames: readonly Frame[]): { readonly lagSeconds: number; readonly correlation: number } {
  const heard = loudnessByStep(frames);
  const lags = Array.from({ length: 2 * MOST_STEPS + 1 }, (_, k) => k - MOST_STEPS);
  const scored = lags.map((lag) => ({
    lagSeconds: lag * STEP_SECONDS,
    correlation: correlation(
      frames.flatMap(({ time, opening }) => {
        const loudness = heard.get(Math.round(time / STEP_SECONDS) - lag);
        return loudness === undefined ? [] : [[loudness, opening] as const];
      }),
    ),
  }));
  return scored.reduce((best, next) => (next.correlation > best.correlation ? next : best));
}

/** Loudness by the number of the step; what several frames heard counts once. */
function loudnessByStep(frames: readonly Frame[]): ReadonlyMap<number, number> {
  return new Map(
    frames.flatMap(({ time, loudness }) => loudness.map((value, k) => [Math.round(time / STEP_SECONDS) - k, value] as const).reverse()),
  );
}

/** Pearson's. */
function correlation(pairs: readonly (readonly [number, number])[]): number {
  const mean = (side: 0 | 1) => pairs.reduce((sum, pair) => sum + pair[side], 0) / pairs.length;
  const [meanA, meanB] = [mean(0), mean(1)];
  const [ab, aa, bb] = pairs.reduce(
    (sums, [a, b]) => [sums[0] + (a - meanA) * (b - meanB), sums[1] + (a - meanA) ** 2, sums[2] + (b - meanB) ** 2],
    [0, 0, 0],
  );
  return ab / Math.sqrt(aa * bb);
}
