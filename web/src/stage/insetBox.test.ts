import { expect, it } from 'vitest';
import { insetBox } from './insetBox';

it('is centred on the points, of the shape of an inset (3 to 2), with room about the wider side', () => {
  const points: [number, number][] = [
    [10, 40],
    [100, 60],
  ];
  expect(insetBox(points)).toEqual({ x: -17, y: 2, width: 144, height: 96 });
});

it('holds points that are higher than wide', () => {
  const points: [number, number][] = [
    [0, 0],
    [1, 100],
  ];
  expect(insetBox(points)).toMatchObject({ y: -30, height: 160 });
});
