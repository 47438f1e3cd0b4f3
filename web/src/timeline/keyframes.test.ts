import { expect, test } from 'vitest';
import type { Pose, Track } from '../api/schema';
import { withKeysBaked, withKeysLifted } from './bakedKeys';
import { keyframesOf, withKeyframe, withoutKeyframe } from './keyframes';
import { poseAt, sampledPose } from './track';

const TRACK: Track = { schema_version: 1, name: 't', duration: 2, fps: 10, articulators: { jaw: Array(20).fill(0.1) }, landmarks: null };
const smiling = (smile: number): Pose => ({ articulators: { smile }, offsets: null });
const KEYED = withKeyframe(withKeyframe(TRACK, 0.5, smiling(-0.8)), 1.5, smiling(1.6)); // -0.8, then 0.8

test('a pose is eased from key to key, on top of the track', () => {
  expect(poseAt(KEYED, 0).articulators).toEqual({ jaw: 0.1, smile: -0.8 }); // held before the first
  expect(poseAt(KEYED, 1).articulators.smile).toBeCloseTo(0); // half way
  expect(poseAt(KEYED, 1.25).articulators.smile).toBeCloseTo(0.8 * Math.SQRT1_2); // three quarters: -cos of 135°
  expect(poseAt(KEYED, 1.9).articulators.smile).toBe(0.8);
});

test('a key lies on a frame and adds to what was there', () => {
  const twice = withKeyframe(KEYED, 1.52, smiling(0.1));
  expect(keyframesOf(twice).map(({ t }) => t)).toEqual([0.5, 1.5]);
  expect(poseAt(twice, 1.5).articulators.smile).toBeCloseTo(0.9);
});

test('a deleted key leaves the others', () => {
  expect(keyframesOf(withoutKeyframe(KEYED, 0.5)).map(({ t }) => t)).toEqual([1.5]);
});

test('baked frames give the same poses, and lift again', () => {
  const baked = withKeysBaked(KEYED);
  for (const seconds of [0, 0.7, 1.2, 1.9])
    expect(sampledPose(baked, seconds).articulators).toEqual({ neutral: 0, ...poseAt(KEYED, seconds).articulators });
  expect(withKeysLifted(baked)).toEqual(KEYED);
});

test('offsets are keyed, too, and do not close an open mouth', () => {
  const offsets = Array.from({ length: 68 }, (): [number, number] => [0.2, 0]);
  const baked = withKeysBaked(withKeyframe(TRACK, 1, { articulators: {}, offsets }));
  expect(sampledPose(baked, 0.5)).toEqual({ articulators: { neutral: 0, jaw: 0.1 }, offsets });
});

test('keyframes of a damaged file count as none', () => {
  expect(keyframesOf({ ...TRACK, keyframes: [{ t: 'soon' }] } as Track)).toEqual([]);
});
