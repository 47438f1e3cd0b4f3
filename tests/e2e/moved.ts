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
