import { describe, expect, it } from 'vitest';
import { fitView, panBy, toPortrait, toScreen, viewBoxOf, zoomAt } from './view';

const PORTRAIT = { width: 600, height: 800 };
const STAGE = { width: 1000, height: 700 };

describe('view', () => {
  it('shows the whole portrait when fitted', () => {
    const view = fitView(PORTRAIT, STAGE);
    for (const corner of [toScreen(view, STAGE, [0, 0]), toScreen(view, STAGE, [600, 800])]) {
      expect(corner[0]).toBeGreaterThanOrEqual(0);
      expect(corner[0]).toBeLessThanOrEqual(STAGE.width);
      expect(corner[1]).toBeGreaterThanOrEqual(0);
      expect(corner[1]).toBeLessThanOrEqual(STAGE.height);
    }
  });

  it('keeps the point under the pointer while zooming', () => {
    const view = fitView(PORTRAIT, STAGE);
    const zoomed = zoomAt(view, [420, 130], 3, PORTRAIT, STAGE);
    const [x, y] = toPortrait(zoomed, STAGE, [420, 130]);
    const [x0, y0] = toPortrait(view, STAGE, [420, 130]);
    expect(x).toBeCloseTo(x0, 9);
    expect(y).toBeCloseTo(y0, 9);
  });

  it('goes from portrait to screen and back', () => {
    const view = zoomAt(fitView(PORTRAIT, STAGE), [10, 20], 2.5, PORTRAIT, STAGE);
    const [x, y] = toPortrait(view, STAGE, toScreen(view, STAGE, [123, 456]));
    expect([x, y]).toEqual([expect.closeTo(123, 9), expect.closeTo(456, 9)]);
  });

  it('follows a pan but never loses the portrait', () => {
    const view = { centre: [300, 400] as [number, number], scale: 2 };
    expect(panBy(view, [20, -40], PORTRAIT).centre).toEqual([290, 420]);
    expect(panBy(view, [1e6, 1e6], PORTRAIT).centre).toEqual([0, 0]);
  });

  it('is written as a viewBox in portrait pixels', () => {
    expect(viewBoxOf({ centre: [300, 400], scale: 2 }, STAGE)).toBe('50.000 225.000 500.000 350.000');
  });
});
