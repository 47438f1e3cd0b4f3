/** Renders a scene as live SVG: three groups, one path element a path, clip paths for the openings. Frames change only `d`. */
import type { LinearFill, LocalPath, Scene, ScenePath } from '../api/schema';
import { LAYER_NAMES, type LayerLook, type LayerName } from '../store/edit';
import { svgElement } from './svg';

export type OpeningName = 'left_eye' | 'right_eye' | 'mouth';
export const OPENING_NAMES: readonly OpeningName[] = ['left_eye', 'right_eye', 'mouth'];

const OPENING_OF_PART: Readonly<Record<LocalPath['part'], OpeningName>> = {
  left_eye: 'left_eye',
  left_iris: 'left_eye',
  right_eye: 'right_eye',
  right_iris: 'right_eye',
  mouth_cavity: 'mouth',
  mouth_lower: 'mouth',
  tongue: 'mouth',
  mouth_upper: 'mouth',
};

/** A scene as DOM. `paths` are in painter's order: back, fore, local. */
export type Picture = {
  readonly root: SVGSVGElement;
  readonly canvas: SVGRectElement;
  readonly layers: Readonly<Record<LayerName, SVGGElement>>;
  readonly paths: readonly SVGPathElement[];
  readonly openings: Readonly<Record<OpeningName, SVGPathElement>>;
  readonly gradients: ReadonlyMap<number, SVGLinearGradientElement>;
  /** Ends x1, y1, x2, y2 of every path's gradient at rest; zeros where the fill is solid. */
  readonly axes: Float64Array;
};

export function pictureOf(scene: Scene): Picture {
  const definitions = svgElement('defs', {});
  const openings = {
    left_eye: opening('left_eye', definitions),
    right_eye: opening('right_eye', definitions),
    mouth: opening('mouth', definitions),
  };
  const canvas = svgElement('rect', { width: '100%', height: '100%', fill: scene.canvas });
  const layers = { back: svgElement('g', { id: 'back' }), fore: svgElement('g', { id: 'fore' }), local: svgElement('g', { id: 'local' }) };
  const gradients = new Map<number, SVGLinearGradientElement>();
  const paint = (path: ScenePath, index: number) => {
    if (path.fill.kind === 'linear') gradients.set(index, gradient(index, path.fill));
    return pathElement(path, index);
  };
  const plain = [...scene.back, ...scene.fore].map(paint);
  const local = scene.local.map((path, k) => paint(path, plain.length + k));
  layers.back.append(...plain.slice(0, scene.back.length));
  layers.fore.append(...plain.slice(scene.back.length));
  layers.local.append(...clippedRuns(scene.local, local));
  const root = svgElement('svg', { width: `${scene.width}`, height: `${scene.height}`, viewBox: `0 0 ${scene.width} ${scene.height}` });
  definitions.append(...gradients.values());
  root.append(definitions, canvas, ...LAYER_NAMES.map((name) => layers[name]));
  return { root, canvas, layers, paths: [...plain, ...local], openings, gradients, axes: axesOf(scene) };
}

/** Takes canvas and scenery, which no pose moves, out of a picture, into a root of their own to stand behind it. */
export function takeScenery({ root, canvas, layers }: Picture): SVGSVGElement {
  const scenery = root.cloneNode(false) as SVGSVGElement; // a clone is of its original's kind
  scenery.append(canvas, layers.back);
  return scenery;
}

export function showLayers(picture: Picture, looks: Readonly<Record<LayerName, LayerLook>>): void {
  for (const name of LAYER_NAMES) {
    picture.layers[name].style.display = looks[name].visible ? '' : 'none';
    picture.layers[name].style.opacity = looks[name].opacity === 1 ? '' : `${looks[name].opacity}`;
  }
}

function axesOf({ back, fore, local }: Scene): Float64Array {
  return Float64Array.from(
    [...back, ...fore, ...local].flatMap(({ fill }) => (fill.kind === 'linear' ? [...fill.start, ...fill.end] : [0, 0, 0, 0])),
  );
}

/** `d` of a path at rest: absolute cubics from its control points. */
export function restPathString({ points }: ScenePath): string {
  const text = [`M${points[0]} ${points[1]}`];
  for (let at = 2; at < points.length; at += 6) {
    const controls = Array.from({ length: 6 }, (_, k) => points[(at + k) % points.length]);
    text.push(`C${controls.join(' ')}`);
  }
  return `${text.join('')}Z`;
}

/** Neighbouring local paths of one opening share a clipped group. */
function clippedRuns(paths: readonly LocalPath[], elements: readonly SVGPathElement[]): SVGGElement[] {
  const runs: { readonly name: OpeningName; readonly group: SVGGElement }[] = [];
  paths.forEach(({ part }, index) => {
    const name = OPENING_OF_PART[part];
    if (runs.at(-1)?.name !== name) runs.push({ name, group: svgElement('g', { 'clip-path': `url(#opening-${name})` }) });
    runs.at(-1)?.group.append(elements[index]);
  });
  return runs.map(({ group }) => group);
}

function pathElement(path: ScenePath, index: number): SVGPathElement {
  const paint = svgElement('path', { d: restPathString(path) });
  if (path.fill.kind === 'linear') {
    paint.setAttribute('fill', `url(#fill-${index})`);
    return paint;
  }
  paint.setAttribute('fill', path.fill.colour);
  if (path.fill.opacity < 1) paint.setAttribute('fill-opacity', `${path.fill.opacity}`);
  return paint;
}

function gradient(index: number, { start, end, stops }: LinearFill): SVGLinearGradientElement {
  const [x1, y1] = start.map(String);
  const [x2, y2] = end.map(String);
  const made = svgElement('linearGradient', { id: `fill-${index}`, gradientUnits: 'userSpaceOnUse', x1, y1, x2, y2 });
  stops.forEach(({ colour, opacity }, index) => {
    made.append(svgElement('stop', { offset: `${index / (stops.length - 1)}`, 'stop-color': colour, 'stop-opacity': `${opacity}` }));
  });
  return made;
}

function opening(name: OpeningName, definitions: SVGDefsElement): SVGPathElement {
  const outline = svgElement('path', {});
  const clip = svgElement('clipPath', { id: `opening-${name}` });
  clip.append(outline);
  definitions.append(clip);
  return outline;
}
