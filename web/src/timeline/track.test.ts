import { describe, expect, it } from 'vitest';
import type { Track } from '../api/schema';
import type { Xy } from '../face/vector';
import { demoTrack } from './demo';
import { lanesOf } from './lanes';
import { mixed } from './mixing';
import { poseAt, posedBy } from './track';

const points = (dx: number): Xy[] => Array.from({ length: 68 }, (): Xy => [dx, 2 * dx]);
const TRACK: Track = {
  schema_version: 1,
  name: 't',
  duration: 1,
  fps: 2,
  articulators: { jaw: [0, 1] },
  landmarks: [points(0), points(0.5)],
};

describe('poseAt', () => {
  it('is linear between frames', () => {
    const pose = poseAt(TRACK, 0.25); // half way from frame 0 to frame 1
    expect(pose.articulators.jaw).toBe(0.5);
    expect(pose.offsets?.[40]).toEqual([0.25, 0.5]);
  });

  it('holds the last frame after the end', () => {
    expect(poseAt(TRACK, 9).articulators.jaw).toBe(1);
    expect(poseAt(TRACK, 9).offsets?.[0]).toEqual([0.5, 1]);
  });

  it('starts from a neutral face where landmarks are given, from rest where not', () => {
    expect(poseAt(TRACK, 0.25).articulators.neutral).toBe(1);
    expect(poseAt({ ...TRACK, landmarks: null }, 0.25).articulators.neutral).toBeUndefined();
  });
});

describe('a track on top of a pose', () => {
  it('adds up within the ranges of the channels', () => {
    const sum = mixed(
      { articulators: { jaw: 0.7, smile: 0.2 }, offsets: points(0.1) },
      { articulators: { jaw: 0.6 }, offsets: points(0.2) },
    );
    expect(sum.articulators).toEqual({ jaw: 1, smile: 0.2 });
    expect(sum.offsets?.[3][0]).toBeCloseTo(0.3);
  });

  it('leaves the pose alone at the start', () => {
    const pose = { articulators: { jaw: 0.3 }, offsets: null };
    expect(posedBy(pose, TRACK, 0)).toBe(pose);
  });
});

describe('the demo', () => {
  const demo = demoTrack();

  it('starts and ends at rest', () => {
    for (const [name, values] of Object.entries(demo.articulators ?? {}))
      expect([name, values[0], values.at(-1)]).toEqual([name, 0, expect.closeTo(0, 1)]);
  });

  it('blinks, smiles, speaks and tilts', () => {
    const most = (name: string) => Math.max(...(demo.articulators?.[name] ?? []));
    expect(most('blink_left')).toBe(1);
    expect(most('smile')).toBeGreaterThan(0.5);
    expect(most('jaw')).toBeGreaterThan(0.5);
    expect(most('roll')).toBeGreaterThan(5);
  });

  it('shows in five lanes', () => {
    expect(lanesOf(demo).map(({ label }) => label)).toEqual(['Mouth', 'Lids', 'Brows', 'Gaze', 'Head']);
  });
});
