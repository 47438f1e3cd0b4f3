import { describe, expect, it } from 'vitest';
import { faceEachOther, GROUPS, groupOf, indicesOf, landmarkName, mirrorOf, N_LANDMARKS } from './ibug';

const ALL = Array.from({ length: N_LANDMARKS }, (_, index) => index);

describe('the 68 landmarks', () => {
  it('belong to exactly one group each', () => {
    expect(GROUPS.flatMap(indicesOf)).toEqual(ALL);
    for (const index of ALL) expect(indicesOf(groupOf(index))).toContain(index);
  });

  it('are their own mirror image mirrored twice', () => {
    expect(ALL.map((index) => mirrorOf(mirrorOf(index)))).toEqual(ALL);
  });

  it('keep only the middle line in place when mirrored', () => {
    expect(ALL.filter((index) => mirrorOf(index) === index)).toEqual([8, 27, 28, 29, 30, 33, 51, 57, 62, 66]);
  });

  it('have names of their own', () => {
    expect(new Set(ALL.map(landmarkName)).size).toBe(N_LANDMARKS);
  });

  it('face each other across lips and lids, corners never', () => {
    expect(faceEachOther(62, 66)).toBe(true);
    expect(faceEachOther(41, 37)).toBe(true);
    expect(faceEachOther(48, 57)).toBe(false);
  });
});
