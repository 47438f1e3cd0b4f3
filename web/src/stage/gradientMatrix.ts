/** Turns the motion of a gradient's ends into the `gradientTransform` that carries it out: the similarity between two segments. */

const SMALLEST_SCALE = 1e-4; // a matrix without inverse would paint nothing at all

type Ends = ArrayLike<number>;

/** Takes the ends x1, y1, x2, y2 of `rest` to those of `moved`. Segments without length are shifted only. */
export function gradientMatrix(rest: Ends, moved: Ends): string {
  const [dx, dy] = [rest[2] - rest[0], rest[3] - rest[1]];
  const [ex, ey] = [moved[2] - moved[0], moved[3] - moved[1]];
  const square = dx * dx + dy * dy;
  const cosine = square === 0 ? 1 : (dx * ex + dy * ey) / square;
  const sine = square === 0 ? 0 : (dx * ey - dy * ex) / square;
  const [a, b] = Math.hypot(cosine, sine) < SMALLEST_SCALE ? [SMALLEST_SCALE, 0] : [cosine, sine];
  const shift = [moved[0] - a * rest[0] + b * rest[1], moved[1] - b * rest[0] - a * rest[1]];
  return `matrix(${a.toFixed(5)} ${b.toFixed(5)} ${(-b).toFixed(5)} ${a.toFixed(5)} ${shift[0].toFixed(2)} ${shift[1].toFixed(2)})`;
}
