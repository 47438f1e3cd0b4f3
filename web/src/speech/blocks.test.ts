import { describe, expect, it } from 'vitest';
import { added, type Block, type Blocks, changed, endOf, LEAST_SECONDS, moved, removed, retimed } from './blocks';
import type { Viseme } from './visemes';

const DURATION = 1;
const block = (t: number, d: number, viseme: Viseme): Block => ({ t, d, viseme, weight: 1 });
/** Rest, p, a from 0 to 1 without gaps. */
const WORD: Blocks = [block(0, 0.2, 'sil'), block(0.2, 0.2, 'PP'), block(0.4, 0.6, 'aa')];
const GAPPED: Blocks = [block(0.1, 0.1, 'PP'), block(0.5, 0.2, 'aa')];

const edges = (blocks: Blocks) => blocks.map(({ t, d, viseme }) => `${viseme} ${t.toFixed(2)}–${(t + d).toFixed(2)}`);

describe('moving and retiming', () => {
  it('takes the time from the neighbours that it touches', () => {
    expect(edges(moved(WORD, 1, 0.3, DURATION))).toEqual(['sil 0.00–0.30', 'PP 0.30–0.50', 'aa 0.50–1.00']);
    expect(edges(retimed(WORD, 1, 'end', 0.7, DURATION))).toEqual(['sil 0.00–0.20', 'PP 0.20–0.70', 'aa 0.70–1.00']);
  });

  it('leaves neighbours alone across a gap until it meets them', () => {
    expect(edges(moved(GAPPED, 1, 0.3, DURATION))).toEqual(['PP 0.10–0.20', 'aa 0.30–0.50']);
    expect(edges(retimed(GAPPED, 1, 'start', 0.15, DURATION))).toEqual(['PP 0.10–0.15', 'aa 0.15–0.70']);
  });

  it.each([-5, 0, 0.21, 0.55, 5])('keeps order, least lengths and the clip, wherever a block is carried to (%d s)', (time) => {
    const results = WORD.flatMap((_, index) => [
      moved(WORD, index, time, DURATION),
      retimed(WORD, index, 'start', time, DURATION),
      retimed(WORD, index, 'end', time, DURATION),
    ]);
    for (const blocks of results) expectSound(blocks);
  });
});

describe('adding and removing', () => {
  it('cuts a new block out of the one beneath', () => {
    expect(edges(added(WORD, 0.7, 'FF', DURATION))).toEqual([
      'sil 0.00–0.20',
      'PP 0.20–0.40',
      'aa 0.40–0.64',
      'FF 0.64–0.76',
      'aa 0.76–1.00',
    ]);
  });

  it('swallows scraps that no mouth could show', () => {
    expect(edges(added(WORD, 0.33, 'FF', DURATION))[2]).toBe('FF 0.27–0.40'); // 0.01 s of p would be left behind it
  });

  it('fills a gap no further than it goes, and refuses where there is no room', () => {
    expect(edges(added(GAPPED, 0.25, 'U', DURATION))).toEqual(['PP 0.10–0.20', 'U 0.20–0.32', 'aa 0.50–0.70']);
    const tight = [block(0, 0.5, 'aa'), block(0.52, 0.48, 'O')];
    expect(added(tight, 0.51, 'PP', DURATION)).toBe(tight);
  });

  it('gives the time of a removed block to the one before it', () => {
    expect(edges(removed(WORD, 1))).toEqual(['sil 0.00–0.40', 'aa 0.40–1.00']);
    expect(edges(removed(WORD, 0))).toEqual(['PP 0.00–0.40', 'aa 0.40–1.00']);
    expect(edges(removed(GAPPED, 1))).toEqual(['PP 0.10–0.20']);
  });
});

it('a changed viseme forgets how far the old one opened', () => {
  expect(changed([{ ...WORD[2], weight: 0.6 }], 0, 'O')).toEqual([{ ...WORD[2], viseme: 'O', weight: 1 }]);
});

function expectSound(blocks: Blocks): void {
  blocks.forEach((current, index) => {
    expect(current.d).toBeGreaterThan(LEAST_SECONDS - 1e-9);
    expect(current.t).toBeGreaterThanOrEqual(index === 0 ? 0 : endOf(blocks[index - 1]) - 1e-9);
  });
  expect(endOf(blocks[blocks.length - 1])).toBeLessThanOrEqual(DURATION + 1e-9);
}
