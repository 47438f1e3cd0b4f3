/** What part of the portrait the stage shows: portrait pixels to screen pixels (from the stage's top left corner) and back. */
import type { Xy } from '../face/vector';

export type Size = { readonly width: number; readonly height: number };

/** `centre` in portrait pixels; `scale` in screen pixels per portrait pixel. */
export type View = { readonly centre: Xy; readonly scale: number };

export const ZOOM_STEP = 1.25;
// Screen pixels left free around a fitted portrait; the options stand above it and the hint below.
const MARGINS = { top: 60, bottom: 44, side: 24 } as const;
const MIN_PORTRAIT_ON_SCREEN = 48; // screen pixels of its longer side
const MAX_SCALE = 64;

export function fitView(portrait: Size, stage: Size): View {
  const free = { width: stage.width - 2 * MARGINS.side, height: stage.height - MARGINS.top - MARGINS.bottom };
  const scale = limited(Math.min(free.width / portrait.width, free.height / portrait.height), portrait);
  const below = (MARGINS.top - MARGINS.bottom) / 2 / scale;
  return { centre: [portrait.width / 2, portrait.height / 2 - below], scale };
}

/** Zoomed by `factor` so that what lies under `screen` stays there. */
export function zoomAt(view: View, screen: Xy, factor: number, portrait: Size, stage: Size): View {
  const scale = limited(view.scale * factor, portrait);
  const [x, y] = toPortrait(view, stage, screen);
  const keep = 1 - view.scale / scale;
  return { scale, centre: [view.centre[0] + (x - view.centre[0]) * keep, view.centre[1] + (y - view.centre[1]) * keep] };
}

/** Moved so that the portrait follows a drag of `screenDrag`; some of it always stays on the stage. */
export function panBy(view: View, screenDrag: Xy, portrait: Size): View {
  const x = view.centre[0] - screenDrag[0] / view.scale;
  const y = view.centre[1] - screenDrag[1] / view.scale;
  return { ...view, centre: [between(x, 0, portrait.width), between(y, 0, portrait.height)] };
}

export function toPortrait(view: View, stage: Size, [x, y]: Xy): Xy {
  return [view.centre[0] + (x - stage.width / 2) / view.scale, view.centre[1] + (y - stage.height / 2) / view.scale];
}

export function toScreen(view: View, stage: Size, [x, y]: Xy): Xy {
  return [stage.width / 2 + (x - view.centre[0]) * view.scale, stage.height / 2 + (y - view.centre[1]) * view.scale];
}

/** `viewBox` of an SVG that fills the stage. */
export function viewBoxOf(view: View, stage: Size): string {
  const [x, y] = toPortrait(view, stage, [0, 0]);
  return [x, y, stage.width / view.scale, stage.height / view.scale].map((value) => value.toFixed(3)).join(' ');
}

const between = (value: number, low: number, high: number) => Math.min(high, Math.max(low, value));
const limited = (scale: number, { width, height }: Size) => between(scale, MIN_PORTRAIT_ON_SCREEN / Math.max(width, height), MAX_SCALE);
