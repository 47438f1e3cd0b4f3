/** Finds the point under the pointer. */
import { distance, type Xy } from '../../face/vector';

const GRAB_RADIUS = 10; // screen pixels

/** Index of the point nearest to `p` within reach, or null. `scale`: screen pixels per unit of the points. */
export function nearestPoint(points: readonly Xy[], p: Xy, scale: number): number | null {
  let nearest: number | null = null;
  let reach = GRAB_RADIUS / scale;
  points.forEach((point, index) => {
    const away = distance(point, p);
    if (away > reach) return;
    nearest = index;
    reach = away;
  });
  return nearest;
}
