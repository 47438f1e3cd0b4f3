/** Turns a score into the text of an animated SVG. Runs where there is no DOM, too: the writer works in a thread of its own. */
import type { Scene } from '../api/schema';
import { buildRig } from '../rig/rig';
import { drawingOf } from './drawing';
import type { Forecast } from './forecast';
import { withOpacities } from './layerLooks';
import { type Score, verticesAt } from './motion';

const FPS = 25; // frames that keyframes are chosen from; the picture itself moves between them
const TOLERANCE = 0.5; // portrait pixels, for portraits up to TOLERANCE_SIDE
const TOLERANCE_SIDE = 1024; // the longer side that a portrait is shown with at most, nearly always
const SAMPLED_PATHS = 8; // a forecast writes one path of so many

export type SvgTiming = {
  readonly looped: boolean;
  readonly durationSeconds: number;
  /** Times the usual tolerance that points may be off between keyframes. */
  readonly coarseness: number;
};

/** Script-free animated SVG of the first `durationSeconds` of the track. */
export function animatedSvg(score: Score, { looped, durationSeconds, coarseness }: SvgTiming): string {
  const { core, width, height, fills } = drawingOf(score.scene);
  const rig = buildRig(score.scene, score.landmarks);
  try {
    const count = Math.max(2, 1 + Math.round(durationSeconds * FPS));
    const all = new Float64Array(count * rig.restVertices.length);
    for (let frame = 0; frame < count; frame += 1)
      all.set(verticesAt({ ...score, rig }, (frame / (count - 1)) * durationSeconds), frame * rig.restVertices.length);
    const text = rig.animatedSvg(core, all, {
      durationSeconds,
      tolerance: coarseness * TOLERANCE * Math.max(1, Math.max(width, height) / TOLERANCE_SIDE),
      looped,
      title: score.name,
      description: descriptionOf(fills.length, score.captions),
    });
    return withOpacities(text, score.layers);
  } finally {
    rig.dispose();
  }
}

/** For who does not see it: what it is, and what it says. */
function descriptionOf(pathCount: number, captions: Score['captions']): string {
  const words = captions.map(({ text }) => text).join(' ');
  return `Animated vector portrait of ${pathCount} paths.${words && ` It says: “${words}”`} Made with VectorTalker.`;
}

/** Writes every eighth path, and reckons from it. */
export function forecastSvg(score: Score, timing: SvgTiming): Forecast {
  const start = performance.now();
  const text = animatedSvg({ ...score, scene: everyNth(score.scene, SAMPLED_PATHS) }, timing);
  return { bytes: text.length * SAMPLED_PATHS, seconds: ((performance.now() - start) / 1000) * SAMPLED_PATHS };
}

function everyNth(scene: Scene, n: number): Scene {
  const kept = <T>(paths: readonly T[]) => paths.filter((_, index) => index % n === 0);
  return { ...scene, back: kept(scene.back), fore: kept(scene.fore), local: kept(scene.local) };
}
