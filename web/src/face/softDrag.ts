/** Turns the drag of one landmark into displacements of all 68. */
import { faceEachOther, mirrorOf, N_LANDMARKS } from './ibug';
import { distance, scale, type Xy } from './vector';

export type Reach = {
  /** Radius of the falloff, in the unit of `rest`. */
  readonly radius: number;
  /** Move the grabbed landmark alone. */
  readonly single: boolean;
  /** Move the other half of the face by the mirrored drag. */
  readonly mirrored: boolean;
};

/**
 * Displacements (68 × [dx, dy]) when landmark `index` is dragged by `drag`: the others follow with a raised cosine of their
 * rest distance. The opposite lip or lid stays; landmarks of the middle line move only up and down when mirrored.
 */
export function softDrag(rest: readonly Xy[], index: number, drag: Xy, reach: Reach): Xy[] {
  const own = pull(rest, index, drag, reach);
  if (!reach.mirrored) return own;
  const mirror = mirrorOf(index);
  if (mirror === index) return own.map(([, dy]) => [0, dy]);
  const other = pull(rest, mirror, [-drag[0], drag[1]], reach);
  return own.map((moved, k) => stronger(moved, other[k]));
}

function pull(rest: readonly Xy[], index: number, drag: Xy, { radius, single }: Reach): Xy[] {
  return Array.from({ length: N_LANDMARKS }, (_, k) => {
    if (k === index) return drag;
    if (single || faceEachOther(index, k)) return [0, 0];
    return scale(drag, falloff(distance(rest[index], rest[k]) / radius));
  });
}

const PRESSURE_DOUBLINGS = 2; // of the radius, from the lightest touch to the heaviest

/** How far a drag reaches with a pen pressed so hard, 0 to 1: half as far, as far as set at half the pressure, twice as far. Null: no pen. */
export function pressedRadius(radius: number, pressure: number | null): number {
  return pressure === null ? radius : radius * 2 ** (PRESSURE_DOUBLINGS * (pressure - 0.5));
}

/** Raised cosine: 1 at distance 0, 0 from distance 1 on. */
export function falloff(relativeDistance: number): number {
  return relativeDistance < 1 ? (1 + Math.cos(Math.PI * relativeDistance)) / 2 : 0;
}

const stronger = (a: Xy, b: Xy): Xy => (Math.hypot(...a) >= Math.hypot(...b) ? a : b);
