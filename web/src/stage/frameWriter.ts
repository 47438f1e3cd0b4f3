/** Writes frames of a rig into a picture's DOM: only what differs from what it shows, since every write is styled and laid out anew. */
import type { ScenePath } from '../api/schema';
import type { Frame } from '../rig/rig';
import { gradientMatrix } from './gradientMatrix';
import type { Picture } from './picture';

const VISIBLE_LEVELS = 0.5; // of 255: a gradient off by less rounds to the same colour, nearly everywhere

export type FrameWriter = {
  /** Writes every path; for a rig that the picture has not shown before. */
  readonly writeAll: (frame: Frame) => void;
  /** Writes the changed paths. While `isMoving`, gradients may lag by what nobody sees; the first frame at rest catches up. */
  readonly write: (frame: Frame, isMoving: boolean) => void;
};

export function frameWriter({ paths, gradients, axes }: Picture, fills: readonly ScenePath['fill'][]): FrameWriter {
  const contrasts = fills.map(contrastOf);
  const data: string[] = [];
  const ends = axes.slice();
  const lagging = new Map<number, Float64Array>();

  const writePath = (path: number, d: string) => {
    if (data[path] === d) return;
    data[path] = d;
    paths[path].setAttribute('d', d);
  };
  const writeGradient = (path: number, moved: Float64Array) => {
    const at = 4 * path;
    lagging.delete(path);
    if (moved.every((value, k) => value === ends[at + k])) return;
    ends.set(moved, at);
    gradients.get(path)?.setAttribute('gradientTransform', gradientMatrix(axes.subarray(at, at + 4), moved));
  };
  const isLagHidden = (path: number, moved: Float64Array) =>
    contrasts[path] * shiftBetween(ends.subarray(4 * path, 4 * path + 4), moved) < VISIBLE_LEVELS;

  const write = (frame: Frame, isMoving: boolean) => {
    frame.changed.forEach((path, k) => {
      writePath(path, frame.d(path));
      if (!gradients.has(path)) return;
      const moved = frame.axes.subarray(4 * k, 4 * k + 4);
      if (isMoving && isLagHidden(path, moved)) lagging.set(path, moved);
      else writeGradient(path, moved);
    });
    if (!isMoving) for (const [path, moved] of lagging) writeGradient(path, moved);
  };
  const writeAll = (frame: Frame) => {
    lagging.clear();
    paths.forEach((_, path) => {
      writePath(path, frame.d(path));
      if (gradients.has(path)) writeGradient(path, axes.subarray(4 * path, 4 * path + 4));
    });
    write(frame, false);
  };
  return { write, writeAll };
}

/** Steepest change of any channel, in levels of 255 over the length of the axis; 0 for a solid fill. */
function contrastOf(fill: ScenePath['fill']): number {
  if (fill.kind === 'solid') return 0;
  const levels = fill.stops.map(({ colour, opacity }) => [...levelsOf(colour), 255 * opacity]);
  const steps = levels.slice(1).map((stop, index) => Math.max(...stop.map((level, channel) => Math.abs(level - levels[index][channel]))));
  return steps.length * Math.max(...steps);
}

const levelsOf = (colour: string) => [1, 3, 5].map((at) => Number.parseInt(colour.slice(at, at + 2), 16));

/** How far the ends moved, in lengths of the axis: the share of the contrast by which a colour between them is off. */
function shiftBetween(shown: Float64Array, moved: Float64Array): number {
  const shift = Math.max(Math.hypot(moved[0] - shown[0], moved[1] - shown[1]), Math.hypot(moved[2] - shown[2], moved[3] - shown[3]));
  return shift === 0 ? 0 : shift / Math.hypot(shown[2] - shown[0], shown[3] - shown[1]);
}
