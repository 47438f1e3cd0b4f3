import { describe, expect, it } from 'vitest';
import { carried, gripAt } from './blockDrag';
import { blockKey } from './blockKeys';
import type { Blocks } from './blocks';

const DURATION = 1;
const BLOCKS: Blocks = [
  { t: 0, d: 0.2, viseme: 'sil', weight: 1 },
  { t: 0.2, d: 0.2, viseme: 'PP', weight: 1 },
  { t: 0.4, d: 0.6, viseme: 'aa', weight: 1 },
];
const NONE = { shiftKey: false, ctrlKey: false, metaKey: false };
const press = (key: string, held: Partial<typeof NONE> = {}, index = 1) => blockKey({ key, ...NONE, ...held }, BLOCKS, index, DURATION);

describe('keys on a viseme', () => {
  it('go to the neighbours and stop at the ends', () => {
    expect(press('ArrowRight')).toEqual({ blocks: BLOCKS, selected: 2 });
    expect(press('ArrowRight', {}, 2)?.selected).toBe(2);
    expect(press('ArrowLeft', {}, 0)?.selected).toBe(0);
  });

  it('move by a frame with Shift, retime the end with Ctrl, the start with both', () => {
    expect(press('ArrowRight', { shiftKey: true })?.blocks[1]).toEqual({ ...BLOCKS[1], t: expect.closeTo(0.22), d: expect.closeTo(0.2) });
    expect(press('ArrowRight', { ctrlKey: true })?.blocks[1].d).toBeCloseTo(0.22);
    expect(press('ArrowLeft', { ctrlKey: true, shiftKey: true })?.blocks[1].t).toBeCloseTo(0.18);
  });

  it('remove it and insert into it', () => {
    expect(press('Delete')).toMatchObject({ blocks: { length: 2 }, selected: 0 });
    const inserted = press('Insert');
    expect(inserted?.blocks[inserted.selected]).toMatchObject({ viseme: 'aa', t: expect.closeTo(0.24) });
  });

  it('leave all other keys to the page', () => {
    expect(press('p')).toBeNull();
  });
});

describe('grips', () => {
  const PIXEL = 0.005; // seconds
  it('are edges within 5 px, and the middle between', () => {
    expect(gripAt(BLOCKS, 0.21, PIXEL)).toEqual({ index: 1, part: 'start' });
    expect(gripAt(BLOCKS, 0.3, PIXEL)).toEqual({ index: 1, part: 'middle' });
    expect(gripAt(BLOCKS, 0.39, PIXEL)).toEqual({ index: 1, part: 'end' });
    expect(gripAt(BLOCKS, 1.5, PIXEL)).toBeNull();
  });

  it('carry what they hold', () => {
    expect(carried(BLOCKS, { index: 1, part: 'end' }, 0.1, DURATION)[1].d).toBeCloseTo(0.3);
    expect(carried(BLOCKS, { index: 1, part: 'middle' }, 0.1, DURATION)[1].t).toBeCloseTo(0.3);
  });
});
