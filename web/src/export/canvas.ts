/** Paints frames of a drawing on a 2D canvas, from flat arrays, without any path strings. */
import { LAYER_NAMES } from '../store/edit';
import { cssColour, type Drawing, type DrawingFrame } from './drawing';
import type { LayerLooks } from './layerLooks';

type Context = CanvasRenderingContext2D | OffscreenCanvasRenderingContext2D;

export type PixelSize = { readonly width: number; readonly height: number };

/** Size whose longer side is about `longerSide`, both sides even as video codecs want them. */
export function evenSize({ width, height }: PixelSize, longerSide: number): PixelSize {
  const scale = longerSide / Math.max(width, height);
  const even = (side: number) => Math.max(2, 2 * Math.round((side * scale) / 2));
  return { width: even(width), height: even(height) };
}

/** Fills the whole canvas with one frame. Layers that are seen through are painted on a sheet of their own first. */
export function paintFrame(context: Context, drawing: Drawing, looks: LayerLooks, frame: DrawingFrame): void {
  fitTo(context, drawing);
  context.fillStyle = drawing.canvas;
  context.fillRect(0, 0, drawing.width, drawing.height);
  for (const name of LAYER_NAMES) {
    const { opacity } = looks[name];
    if (opacity === 1) paintPaths(context, drawing, frame, drawing.ranges[name]);
    else paintThrough(context, opacity, (sheet) => paintPaths(fitTo(sheet, drawing), drawing, frame, drawing.ranges[name]));
  }
}

/** Lets portrait pixels fill the canvas. */
function fitTo<C extends Context>(context: C, drawing: Drawing): C {
  const { width, height } = context.canvas;
  context.setTransform(width / drawing.width, 0, 0, height / drawing.height, 0, 0);
  return context;
}

function paintThrough(context: Context, opacity: number, paint: (sheet: Context) => void): void {
  const { width, height } = context.canvas;
  const sheet = new OffscreenCanvas(width, height);
  const sheetContext = sheet.getContext('2d');
  if (!sheetContext) throw new Error('This browser gives no 2D canvas.');
  paint(sheetContext);
  context.save();
  context.resetTransform();
  context.globalAlpha = opacity;
  context.drawImage(sheet, 0, 0);
  context.restore();
}

/** Neighbouring paths of one opening share its clip. */
function paintPaths(context: Context, drawing: Drawing, frame: DrawingFrame, [from, to]: readonly [number, number]): void {
  let clip: number | null = null;
  for (let path = from; path < to; path += 1) {
    const opening = drawing.openings[path];
    if (opening !== clip) {
      if (clip !== null) context.restore();
      if (opening !== null) clipBy(context, frame.openings[opening]);
      clip = opening;
    }
    paintPath(context, drawing, frame, path);
  }
  if (clip !== null) context.restore();
}

function paintPath(context: Context, drawing: Drawing, frame: DrawingFrame, path: number): void {
  const fill = drawing.fills[path];
  if (fill.kind === 'linear') {
    const [x1, y1, x2, y2] = frame.axes[path];
    const isPoint = x1 === x2 && y1 === y2; // SVG then paints the last stop, a canvas nothing
    const colours = fill.stops.map(cssColour);
    context.fillStyle = isPoint ? colours[colours.length - 1] : gradient(context, colours, [x1, y1, x2, y2]);
  } else context.fillStyle = cssColour(fill);
  trace(context, frame.paths[path]);
  context.fill();
}

function gradient(context: Context, colours: readonly string[], ends: readonly [number, number, number, number]): CanvasGradient {
  const made = context.createLinearGradient(...ends);
  colours.forEach((colour, index) => {
    made.addColorStop(index / (colours.length - 1), colour);
  });
  return made;
}

function clipBy(context: Context, outline: Float64Array): void {
  context.save();
  trace(context, outline);
  context.clip();
}

/** Begins a path along a closed chain of cubics. */
function trace(context: Context, points: Float64Array): void {
  context.beginPath();
  if (points.length === 0) return;
  context.moveTo(points[0], points[1]);
  for (let at = 2; at < points.length; at += 6) {
    const end = (at + 4) % points.length;
    context.bezierCurveTo(points[at], points[at + 1], points[at + 2], points[at + 3], points[end], points[end + 1]);
  }
  context.closePath();
}
