/** Where a pose may change the picture: in the mesh triangles that moved, and in the openings that show the mouth and the eyes. */
import type { Page } from '@playwright/test';
import { type Point, settled, stage } from './editor';

/** Mesh and openings as they stand, as path data in pixels of the stage. */
export type Standing = { readonly triangles: readonly string[]; readonly openings: readonly string[] };

export async function standing(page: Page): Promise<Standing> {
  await page.getByRole('button', { name: 'Mesh' }).click();
  await settled(page);
  const mesh = (await page.locator('.overlay .mesh').getAttribute('d')) ?? '';
  await page.getByRole('button', { name: 'Mesh' }).click();
  await settled(page);
  const origin = await stage(page).boundingBox();
  const openings = await page.evaluate(
    ([left, top]) => {
      const view = document.querySelector<SVGGElement>('#local')?.getScreenCTM();
      if (!view) throw new Error('no picture on the page');
      let x = 0;
      let at = 0;
      const toStage = (number: string) => {
        const isY = at++ % 2 === 1;
        if (!isY) x = Number(number);
        return String(isY ? view.d * Number(number) + view.f - top : view.a * x + view.e - left);
      };
      const outlines = document.querySelectorAll('clipPath[id^="opening-"] path');
      return Array.from(outlines, (outline) => (outline.getAttribute('d') ?? '').replace(/-?[\d.]+/g, (number) => ` ${toStage(number)}`));
    },
    [origin?.x ?? 0, origin?.y ?? 0] as const,
  );
  return { triangles: mesh.split('Z').filter(Boolean), openings };
}

/** Indices of the triangles that differ. */
export function movedTriangles(before: Standing, after: Standing): number[] {
  return before.triangles.flatMap((triangle, index) => (triangle === after.triangles[index] ? [] : [index]));
}

/** Path data of all that may look different. */
export function movedRegion(before: Standing, after: Standing): string {
  const triangles = movedTriangles(before, after).flatMap((index) => [before.triangles[index], after.triangles[index]]);
  return [...triangles, ...before.openings, ...after.openings].map((d) => `${d}Z`).join('');
}

/** Whether a triangle has a corner at a point of the stage. */
export function hasCorner(triangle: string, { x, y }: Point): boolean {
  const numbers = (triangle.match(/-?[\d.]+/g) ?? []).map(Number);
  return [0, 2, 4].some((k) => Math.hypot(numbers[k] - x, numbers[k + 1] - y) < 1);
}

/**
 * How many points of outlines moved, and those among them that stood outside a region (path data, pixels of the stage) at rest. Handles
 * may stand outside the triangle that their curve lies in, so it is the curves that are asked.
 */
export async function movedPoints(page: Page, rest: readonly string[], posed: readonly string[], region: string) {
  const moves = rest.flatMap((d, index) => {
    const [from, to] = [curvePoints(d), curvePoints(posed[index])];
    if (from.length !== to.length) throw new Error(`path ${index} has ${to.length} points, had ${from.length} at rest`);
    return from.filter(({ x, y }, at) => Math.hypot(to[at].x - x, to[at].y - y) > ROUNDING);
  });
  const outside = await page.evaluate(
    ([points, outline]) => {
      const view = document.querySelector<SVGGElement>('#local')?.getScreenCTM();
      const box = document.querySelector('.stage')?.getBoundingClientRect();
      const context = new OffscreenCanvas(1, 1).getContext('2d');
      if (!view || !box || !context) throw new Error('no picture on the page');
      const area = new Path2D(outline);
      return points.filter(({ x, y }) => {
        const { x: left, y: top } = new DOMPoint(x, y).matrixTransform(view);
        const place = [left - box.left, top - box.top] as const;
        return !context.isPointInPath(area, ...place) && !context.isPointInStroke(area, ...place);
      });
    },
    [moves, region] as const,
  );
  return { count: moves.length, outside };
}

const SAMPLES = 8; // of each cubic
const ROUNDING = 1e-3; // portrait pixels, the sum of a path's relative steps in floating point

/** Points along path data as the rig writes it: `M`, relative cubics after one `c`, `z`. */
function curvePoints(d: string): Point[] {
  if (!/^M[^a-z]*c[^a-z]*z$/i.test(d)) throw new Error(`path data of another form: ${d.slice(0, 80)}`);
  const numbers = (d.match(/-?(\d+\.?\d*|\.\d+)/g) ?? []).map(Number);
  const points: Point[] = [];
  let anchor: Point = { x: numbers[0], y: numbers[1] };
  for (let at = 2; at < numbers.length; at += 6) {
    const [c1, c2, end] = [at, at + 2, at + 4].map((k) => ({ x: anchor.x + numbers[k], y: anchor.y + numbers[k + 1] }));
    for (let k = 0; k < SAMPLES; k += 1) points.push(onCubic([anchor, c1, c2, end], k / SAMPLES));
    anchor = end;
  }
  return points;
}

function onCubic([p0, p1, p2, p3]: readonly Point[], t: number): Point {
  const weights = [(1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t ** 2 * (1 - t), t ** 3];
  const sum = (of: (p: Point) => number) => [p0, p1, p2, p3].reduce((total, p, k) => total + weights[k] * of(p), 0);
  return { x: sum(({ x }) => x), y: sum(({ y }) => y) };
}
