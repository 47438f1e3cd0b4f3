/** Has animated SVG written in a thread of its own, so that the page stays alive and a person can stop it. */
import type { SvgTiming } from './animatedSvg';
import type { Forecast } from './forecast';
import type { Score } from './motion';

export type SvgRequest = { readonly kind: 'write' | 'forecast'; readonly score: Score; readonly timing: SvgTiming };

export type SvgAnswer =
  | { readonly kind: 'write'; readonly text: string }
  | { readonly kind: 'forecast'; readonly forecast: Forecast }
  | { readonly kind: 'failed'; readonly message: string };

const TICK_MILLISECONDS = 200;
const MOST_FORETOLD = 0.97; // the last bit is not done before it is done

/** The text of the animated SVG. Its writer tells nothing on its way, so the progress is the share of the time foretold. */
export async function writeAnimatedSvg(
  score: Score,
  timing: SvgTiming,
  secondsForetold: number,
  signal: AbortSignal,
  onProgress: (share: number) => void,
): Promise<string> {
  const start = performance.now();
  const ticking = setInterval(() => {
    const seconds = (performance.now() - start) / 1000;
    onProgress(Math.min(MOST_FORETOLD, seconds / Math.max(secondsForetold, 0.1)));
  }, TICK_MILLISECONDS);
  try {
    const answer = await asked({ kind: 'write', score, timing }, signal);
    if (answer.kind !== 'write') throw new Error(`The writer answered with ${answer.kind}.`);
    return answer.text;
  } finally {
    clearInterval(ticking);
  }
}

export async function forecastAnimatedSvg(score: Score, timing: SvgTiming, signal: AbortSignal): Promise<Forecast> {
  const answer = await asked({ kind: 'forecast', score, timing }, signal);
  if (answer.kind !== 'forecast') throw new Error(`The writer answered with ${answer.kind}.`);
  return answer.forecast;
}

/** Aborting ends the thread and rejects with the signal's reason. */
function asked(request: SvgRequest, signal: AbortSignal): Promise<SvgAnswer> {
  signal.throwIfAborted();
  const worker = new Worker(new URL('./svgWorker.ts', import.meta.url), { type: 'module' });
  return new Promise<SvgAnswer>((resolve, reject) => {
    signal.addEventListener('abort', () => reject(signal.reason));
    worker.onerror = ({ message }) => reject(new Error(message || 'The SVG writer could not be started.'));
    worker.onmessage = ({ data }: MessageEvent<SvgAnswer>) => (data.kind === 'failed' ? reject(new Error(data.message)) : resolve(data));
    worker.postMessage(request);
  }).finally(() => worker.terminate());
}
