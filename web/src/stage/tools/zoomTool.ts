/** The magnifier: a click zooms in, with Alt out; a drag up or down zooms smoothly. */
import { type Size, ZOOM_STEP, zoomAt } from '../view';
import { NOTHING, type Tool } from './gesture';

const PIXELS_PER_DOUBLING = 120;

export function zoomTool(portrait: () => Size, stage: () => Size): Tool {
  return {
    aim: () => ({ kind: 'canvas' }),
    drag: (_target, { view }, from, to) => {
      const factor = 2 ** ((from.screen[1] - to.screen[1]) / PIXELS_PER_DOUBLING);
      return { kind: 'look', view: zoomAt(view, from.screen, factor, portrait(), stage()) };
    },
    click: (_target, { view }, at) => {
      const factor = at.alt ? ZOOM_STEP ** -2 : ZOOM_STEP ** 2;
      return { kind: 'look', view: zoomAt(view, at.screen, factor, portrait(), stage()) };
    },
    reset: () => NOTHING,
    hint: () => 'Click to zoom in, with Alt out; drag up or down to zoom smoothly',
  };
}
