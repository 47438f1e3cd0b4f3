import { readFileSync } from 'node:fs';
import { describe, expect, it } from 'vitest';
import { readTrack } from './readTrack';

const json = (change: Record<string, unknown>) =>
  JSON.stringify({ schema_version: 1, name: 'n', duration: 2, fps: 25, articulators: { jaw: [0, 1] }, ...change });

describe('track JSON', () => {
  it('keeps what other editors left beside the known fields', () => {
    expect(readTrack(json({ visemes: ['aa'] }), 'a.json')).toMatchObject({ fps: 25, visemes: ['aa'] });
  });

  it.each([
    ['a newer version', { schema_version: 2 }, 'track version 2'],
    ['no version', { schema_version: undefined }, 'no valid schema_version'],
    ['no duration', { duration: 0 }, 'duration of a.json'],
    ['too many frames a second', { fps: 1000 }, 'at most 240'],
    ['67 landmarks', { landmarks: [Array.from({ length: 67 }, () => [0, 0])] }, 'frames of 68'],
    ['nothing to play', { articulators: undefined }, 'neither landmarks nor articulators'],
  ])('refuses %s and says so', (_, change, message) => {
    expect(() => readTrack(json(change), 'a.json')).toThrow(message);
  });

  it('reads the sample track that ships', () => {
    const text = readFileSync(new URL('../../../public/tracks/good-morning.json', import.meta.url), 'utf8');
    const track = readTrack(text, 'good-morning.json');
    expect(track.landmarks?.length).toBe(Math.round(track.duration * track.fps));
  });
});

/** A face 2 wide between the outer eye corners; `lips`: the gap of the inner lips. */
function row(time: number, lips: number): string {
  const points = Array.from({ length: 68 }, (_, index) => [index === 36 ? -1 : index === 45 ? 1 : 0, index >= 65 ? lips : 0]);
  return [time, ...points.flat()].join(',');
}

describe('raw 68-point CSV', () => {
  it('takes the row with closed lips as neutral and the eye distance as unit', () => {
    const track = readTrack([row(0, 0.4), row(0.5, 0), row(1, 0.6)].join('\n'), 'a.csv');
    expect(track.fps).toBe(2);
    expect(track.duration).toBe(1.5);
    expect(track.landmarks?.map((frame) => frame[66][1])).toEqual([0.2, 0, 0.3]);
  });

  it('skips a line of column names', () => {
    const names = ['t', ...Array.from({ length: 136 }, (_, k) => `c${k}`)].join(',');
    expect(readTrack([names, row(0, 0), row(0.1, 1)].join('\n'), 'a.csv').landmarks?.length).toBe(2);
  });

  it.each([
    ['a missing column', [row(0, 0), row(1, 0).replace(/,[^,]*$/, '')], 'Row 2 of a.csv has 136 columns'],
    ['a hole', [row(0, 0), row(1, 0).replace(/,-1,/, ',NaN,')], 'no finite number in column'],
    ['time running backwards', [row(1, 0), row(0, 0)], 'do not ascend'],
    ['a single row', [row(0, 0)], 'a track needs 2'],
  ])('refuses %s and says where', (_, lines, message) => {
    expect(() => readTrack(lines.join('\n'), 'a.csv')).toThrow(message);
  });
});
