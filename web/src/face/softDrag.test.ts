import { describe, expect, it } from 'vitest';
import { N_LANDMARKS } from './ibug';
import { falloff, pressedRadius, softDrag } from './softDrag';
import type { Xy } from './vector';

/** All landmarks in a row, one unit apart. */
const ROW: Xy[] = Array.from({ length: N_LANDMARKS }, (_, index): Xy => [index, 0]);
const movedIndices = (displacements: readonly Xy[]) => displacements.flatMap(([dx, dy], index) => (dx || dy ? [index] : []));

describe('softDrag', () => {
  it('moves a single point alone', () => {
    const moved = softDrag(ROW, 8, [1, 2], { radius: 5, single: true, mirrored: false });
    expect(movedIndices(moved)).toEqual([8]);
    expect(moved[8]).toEqual([1, 2]);
  });

  it('takes neighbours along by a raised cosine and stops at the radius', () => {
    const moved = softDrag(ROW, 8, [0, 1], { radius: 2, single: false, mirrored: false });
    expect(movedIndices(moved)).toEqual([7, 8, 9]);
    expect(moved[9][1]).toBeCloseTo(0.5); // half the radius away: (1 + cos π/2) / 2
  });

  it('leaves the opposite lip where it is', () => {
    const moved = softDrag(ROW, 66, [0, 1], { radius: 10, single: false, mirrored: false });
    expect(moved[62]).toEqual([0, 0]);
    expect(moved[64][1]).toBeGreaterThan(0);
  });

  it('mirrors the drag on the other half', () => {
    const moved = softDrag(ROW, 48, [-1, 2], { radius: 0.5, single: false, mirrored: true });
    expect(moved[48]).toEqual([-1, 2]);
    expect(moved[54]).toEqual([1, 2]);
  });

  it('moves the middle line only up and down when mirrored', () => {
    const moved = softDrag(ROW, 57, [3, 2], { radius: 0.5, single: false, mirrored: true });
    expect(moved[57]).toEqual([0, 2]);
  });
});

describe('falloff', () => {
  it('runs from one to zero', () => {
    expect(falloff(0)).toBe(1);
    expect(falloff(1)).toBe(0);
    expect(falloff(7)).toBe(0);
  });
});

describe('pressedRadius', () => {
  it('is the set radius without a pen and at half its pressure, half of it at a touch, twice at the hardest', () => {
    expect([null, 0.5, 0, 1].map((pressure) => pressedRadius(3, pressure))).toEqual([3, 3, 1.5, 6]);
  });
});
