/** Compares two screenshots in the browser that took them. */
import type { Page } from '@playwright/test';

export type Difference = {
  readonly count: number;
  /** Of 255, in any channel. */
  readonly largest: number;
  readonly left: number;
  readonly top: number;
  readonly right: number;
  readonly bottom: number;
};

const TOLERANCE = 2; // of 255, in any channel
const ANTIALIASING = 1; // pixels beyond an outline that it colours

/** How many pixels of two equally large PNGs differ outside a region (path data, pixels), and the box round them. */
export function difference(page: Page, a: Buffer, b: Buffer, except = ''): Promise<Difference> {
  return page.evaluate(
    async ([first, second, tolerance, region, border]) => {
      const contextOf = (width: number, height: number) => {
        const context = new OffscreenCanvas(width, height).getContext('2d', { willReadFrequently: true });
        if (!context) throw new Error('no 2D context');
        return context;
      };
      const pixels = async (base64: string) => {
        const bytes = Uint8Array.from(atob(base64), (character) => character.charCodeAt(0));
        const bitmap = await createImageBitmap(new Blob([bytes], { type: 'image/png' }));
        const context = contextOf(bitmap.width, bitmap.height);
        context.drawImage(bitmap, 0, 0);
        return context.getImageData(0, 0, bitmap.width, bitmap.height);
      };
      const [p, q] = [await pixels(first), await pixels(second)];
      const excepted = contextOf(p.width, p.height);
      excepted.lineWidth = 2 * border;
      excepted.fill(new Path2D(region));
      excepted.stroke(new Path2D(region));
      const free = excepted.getImageData(0, 0, p.width, p.height).data;
      const found = { count: 0, largest: 0, left: p.width, top: p.height, right: -1, bottom: -1 };
      for (let at = 0; at < p.data.length; at += 4) {
        const change = Math.max(...[0, 1, 2].map((channel) => Math.abs(p.data[at + channel] - q.data[at + channel])));
        if (change <= tolerance || free[at + 3] > 0) continue;
        const x = (at / 4) % p.width;
        const y = Math.floor(at / 4 / p.width);
        found.count += 1;
        found.largest = Math.max(found.largest, change);
        found.left = Math.min(found.left, x);
        found.top = Math.min(found.top, y);
        found.right = Math.max(found.right, x);
        found.bottom = Math.max(found.bottom, y);
      }
      return found;
    },
    [a.toString('base64'), b.toString('base64'), TOLERANCE, except, ANTIALIASING] as const,
  );
}
