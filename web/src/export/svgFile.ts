/** Turns a performance into the text of an animated or a still SVG. */
import type { Scene } from '../api/schema';
import { pathData, type Rig } from '../rig/rig';
import { OPENING_NAMES, type Picture, pictureOf } from '../stage/picture';
import { svgElement } from '../stage/svg';
import { LAYER_NAMES, type LayerLook, type LayerName } from '../store/edit';
import { drawingOf } from './drawing';
import { type Performance, verticesAt } from './motion';

const FPS = 25; // frames that keyframes are chosen from; the picture itself moves between them
const TOLERANCE = 0.5; // portrait pixels, for portraits up to TOLERANCE_SIDE
const TOLERANCE_SIDE = 1024; // the longer side that a portrait is shown with at most, nearly always

const AXIS_NAMES = ['x1', 'y1', 'x2', 'y2'];

export type SvgTiming = { readonly looped: boolean; readonly durationSeconds: number };

/** Script-free animated SVG of the first `durationSeconds` of the track. */
export function animatedSvg(performance: Performance, { looped, durationSeconds }: SvgTiming): string {
  const { core, width, height, fills } = drawingOf(performance.scene);
  const count = Math.max(2, 1 + Math.round(durationSeconds * FPS));
  const frames = Array.from({ length: count }, (_, frame) => verticesAt(performance, (frame / (count - 1)) * durationSeconds));
  const all = new Float64Array(count * frames[0].length);
  frames.forEach((vertices, frame) => {
    all.set(vertices, frame * vertices.length);
  });
  return performance.rig.animatedSvg(core, all, {
    durationSeconds,
    tolerance: TOLERANCE * Math.max(1, Math.max(width, height) / TOLERANCE_SIDE),
    looped,
    title: performance.name,
    description: `Animated vector portrait of ${fills.length} paths. Made with VectorTalker.`,
  });
}

/** Layered SVG of the scene as it stands at `vertices`; hidden layers stay hidden. Without a rig it is at rest. */
export function stillSvg(
  name: string,
  scene: Scene,
  posed: { readonly rig: Rig; readonly vertices: Float64Array } | null,
  looks: Readonly<Record<LayerName, LayerLook>>,
): string {
  const picture = pictureOf(scene);
  if (posed) pose(picture, scene, posed.rig, posed.vertices);
  for (const layer of LAYER_NAMES) {
    if (!looks[layer].visible) picture.layers[layer].setAttribute('display', 'none');
    if (looks[layer].opacity < 1) picture.layers[layer].setAttribute('opacity', `${looks[layer].opacity}`);
  }
  const title = svgElement('title', {});
  title.textContent = name;
  picture.root.setAttribute('role', 'img');
  picture.root.prepend(title);
  return `${new XMLSerializer().serializeToString(picture.root)}\n`;
}

function pose(picture: Picture, scene: Scene, rig: Rig, vertices: Float64Array): void {
  const { axes } = drawingOf(scene);
  for (const { path, points, axis } of rig.movedPoints(vertices, axes)) {
    picture.paths[path].setAttribute('d', pathData(points));
    const gradient = picture.root.querySelector(`#fill-${path}`);
    AXIS_NAMES.forEach((name, at) => {
      gradient?.setAttribute(name, `${axis[at]}`);
    });
  }
  rig.openings(vertices).forEach((d, opening) => {
    picture.openings[OPENING_NAMES[opening]].setAttribute('d', d);
  });
}
