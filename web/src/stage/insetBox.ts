/** What an inset shows of the portrait. */
import type { Xy } from '../face/vector';

/** Screen pixels. */
export const INSET = { width: 156, height: 104 } as const;

const ROOM = 1.6; // times the size of what is looked at

export type Box = { readonly x: number; readonly y: number; readonly width: number; readonly height: number };

/** The box of an inset's shape round points, with room to drag them. */
export function insetBox(points: readonly Xy[]): Box {
  const [xs, ys] = [points.map(([x]) => x), points.map(([, y]) => y)];
  const [left, right, top, bottom] = [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)];
  const width = ROOM * Math.max(right - left, ((bottom - top) * INSET.width) / INSET.height);
  const height = (width * INSET.height) / INSET.width;
  return { x: (left + right - width) / 2, y: (top + bottom - height) / 2, width, height };
}
