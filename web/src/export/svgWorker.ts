/** The thread that writes animated SVG: one request, one answer, then it ends. Stopping it is how a person cancels. */
import { loadRigModule } from '../rig/rig';
import { animatedSvg, forecastSvg } from './animatedSvg';
import type { SvgAnswer, SvgRequest } from './svgThread';

self.onmessage = async ({ data }: MessageEvent<SvgRequest>) => {
  self.postMessage(await answerTo(data));
};

async function answerTo({ kind, score, timing }: SvgRequest): Promise<SvgAnswer> {
  try {
    await loadRigModule();
    if (kind === 'forecast') return { kind, forecast: forecastSvg(score, timing) };
    return { kind, text: animatedSvg(score, timing) };
  } catch (error) {
    return { kind: 'failed', message: error instanceof Error ? error.message : `${error}` };
  }
}
