/** Plane vectors [x, y], y down. */
export type Xy = [number, number];

export const add = (a: Xy, b: Xy): Xy => [a[0] + b[0], a[1] + b[1]];
export const subtract = (a: Xy, b: Xy): Xy => [a[0] - b[0], a[1] - b[1]];
export const scale = (a: Xy, factor: number): Xy => [a[0] * factor, a[1] * factor];
export const distance = (a: Xy, b: Xy): number => Math.hypot(a[0] - b[0], a[1] - b[1]);

/** `a` turned by `radians`, clockwise on the screen (y down). */
export function rotate(a: Xy, radians: number): Xy {
  const cosine = Math.cos(radians);
  const sine = Math.sin(radians);
  return [a[0] * cosine - a[1] * sine, a[0] * sine + a[1] * cosine];
}

/** Mean of at least one point. */
export function centroid(points: readonly Xy[]): Xy {
  const sum = points.reduce<Xy>(add, [0, 0]);
  return scale(sum, 1 / points.length);
}

/** Whether `p` lies inside the polygon, by the even-odd rule. */
export function isInside(p: Xy, polygon: readonly Xy[]): boolean {
  let inside = false;
  polygon.forEach((a, k) => {
    const b = polygon[(k + 1) % polygon.length];
    const straddles = a[1] > p[1] !== b[1] > p[1];
    if (straddles && p[0] < a[0] + ((p[1] - a[1]) / (b[1] - a[1])) * (b[0] - a[0])) inside = !inside;
  });
  return inside;
}

/** Each point moved away from the polygon's centroid by `factor`. */
export function enlarged(polygon: readonly Xy[], factor: number): Xy[] {
  const centre = centroid(polygon);
  return polygon.map((point) => add(centre, scale(subtract(point, centre), factor)));
}
