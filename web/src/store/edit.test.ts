import { describe, expect, it } from 'vitest';
import type { Xy } from '../face/vector';
import { atRest, editOf, isAtRest, offsetsOf, withChannel, withOffsetsAdded, withoutGroup, withoutOffsets, withTrack } from './edit';

const FRESH = editOf('Portrait', null);
const moved = (index: number, by: Xy): Xy[] => Array.from({ length: 68 }, (_, k): Xy => (k === index ? by : [0, 0]));

describe('edits of the pose', () => {
  it('holds a channel within its range', () => {
    expect(withChannel(FRESH, 'jaw', 3).pose.articulators.jaw).toBe(1);
    expect(withChannel(FRESH, 'yaw', -90).pose.articulators.yaw).toBe(-20);
  });

  it('is at rest again when a channel returns to zero', () => {
    expect(isAtRest(withChannel(withChannel(FRESH, 'jaw', 0.5), 'jaw', 0).pose)).toBe(true);
  });

  it('resets a group and leaves the others', () => {
    const posed = withChannel(withChannel(FRESH, 'jaw', 0.5), 'yaw', 5);
    expect(withoutGroup(posed, 'mouth').pose.articulators).toEqual({ yaw: 5 });
  });

  it('adds offsets up and takes single ones back', () => {
    const twice = withOffsetsAdded(withOffsetsAdded(FRESH, moved(57, [0, 0.1])), moved(57, [0.2, 0.1]));
    expect(offsetsOf(twice.pose)[57]).toEqual([0.2, 0.2]);
    expect(withoutOffsets(twice, [57]).pose.offsets).toBeNull();
  });

  it('is no new document when there is nothing to reset', () => {
    expect(atRest(FRESH)).toBe(FRESH);
    expect(withoutOffsets(FRESH, [3])).toBe(FRESH);
  });
});

describe('tracks of a project', () => {
  const track = (name: string) => ({ schema_version: 1 as const, name, duration: 1, fps: 25 });

  it('puts the chosen one first and keeps the others', () => {
    const edit = withTrack(withTrack(FRESH, track('a')), track('b'));
    expect(withTrack(edit, edit.tracks[1]).tracks.map(({ name }) => name)).toEqual(['a', 'b']);
  });
});
