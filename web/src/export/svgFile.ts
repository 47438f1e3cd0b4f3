/** Turns the picture as it stands into the text of a still SVG. */
import type { Scene } from '../api/schema';
import { pathData, type Rig } from '../rig/rig';
import { OPENING_NAMES, type Picture, pictureOf } from '../stage/picture';
import { svgElement } from '../stage/svg';
import { LAYER_NAMES } from '../store/edit';
import { drawingOf } from './drawing';
import type { LayerLooks } from './layerLooks';

const AXIS_NAMES = ['x1', 'y1', 'x2', 'y2'];

/** Layered SVG of the scene as it stands at `vertices`; hidden layers stay hidden. Without a rig it is at rest. */
export function stillSvg(
  name: string,
  scene: Scene,
  posed: { readonly rig: Rig; readonly vertices: Float64Array } | null,
  looks: LayerLooks,
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
