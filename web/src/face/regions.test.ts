import { describe, expect, it } from 'vitest';
import { articulate, outerEyeDistance, regionAt } from './regions';
import type { Xy } from './vector';

/** A schematic face: eyes 100 apart at y = 100, mouth at y = 180, chin at y = 230. */
const FACE: Xy[] = [
  ...arc(17, [100, 110], 80, 120, Math.PI, 0), // jaw, from ear to ear below the chin
  ...line(5, [45, 80], [85, 80]),
  ...line(5, [115, 80], [155, 80]),
  ...line(4, [100, 95], [100, 140]),
  ...line(5, [85, 148], [115, 148]),
  ...eye(50, 90),
  ...eye(110, 150),
  ...ring(12, [100, 180], 30, 12),
  ...ring(8, [100, 180], 22, 4),
];

function line(count: number, from: Xy, to: Xy): Xy[] {
  return Array.from(
    { length: count },
    (_, k): Xy => [from[0] + ((to[0] - from[0]) * k) / (count - 1), from[1] + ((to[1] - from[1]) * k) / (count - 1)],
  );
}

function arc(count: number, centre: Xy, rx: number, ry: number, from: number, to: number): Xy[] {
  return Array.from({ length: count }, (_, k) => from + ((to - from) * k) / (count - 1)).map(
    (a): Xy => [centre[0] + rx * Math.cos(a), centre[1] + ry * Math.sin(a)],
  );
}

function ring(count: number, centre: Xy, rx: number, ry: number): Xy[] {
  return Array.from({ length: count }, (_, k) => Math.PI + (2 * Math.PI * k) / count).map(
    (a): Xy => [centre[0] + rx * Math.cos(a), centre[1] + ry * Math.sin(a)],
  );
}

function eye(left: number, right: number): Xy[] {
  const third = (right - left) / 3;
  return [
    [left, 100],
    [left + third, 94],
    [left + 2 * third, 94],
    [right, 100],
    [left + 2 * third, 106],
    [left + third, 106],
  ];
}

describe('regionAt', () => {
  it.each([
    [[100, 180], 'mouth'],
    [[70, 100], 'left_gaze'],
    [[82, 97], 'left_lid'],
    [[130, 100], 'right_gaze'],
    [[60, 80], 'left_brow'],
    [[100, 215], 'jaw'],
    [[60, 140], 'head'],
    [[500, 500], null],
  ] as [Xy, string | null][])('at %s finds %s', (point, region) => {
    expect(regionAt(FACE, point)).toBe(region);
  });
});

describe('articulate', () => {
  const unit = outerEyeDistance(FACE);

  it('opens the mouth by a drag down and widens it by a drag sideways', () => {
    const { jaw, width } = articulate({}, 'mouth', [0.175 * unit, 0.225 * unit], unit, false);
    expect(jaw).toBeCloseTo(0.5); // half of a travel of 0.45
    expect(width).toBeCloseTo(0.5); // half of a travel of 0.35
  });

  it('starts from the pose it found', () => {
    expect(articulate({ jaw: 0.4 }, 'jaw', [0, -10 * unit], unit, false).jaw).toBe(0);
  });

  it('turns and nods the head, with tilt instead of turn when asked', () => {
    expect(articulate({}, 'head', [0.1 * unit, 0.1 * unit], unit, false)).toEqual({ yaw: expect.closeTo(3), pitch: expect.closeTo(3) });
    expect(articulate({}, 'head', [0.1 * unit, 0.1 * unit], unit, true)).toEqual({ roll: expect.closeTo(3) });
  });
});
