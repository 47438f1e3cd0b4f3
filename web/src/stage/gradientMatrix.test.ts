import { expect, test } from 'vitest';
import { gradientMatrix } from './gradientMatrix';

const numbersOf = (matrix: string) => (matrix.match(/-?[\d.]+/g) ?? []).map(Number);

function carried(matrix: string, x: number, y: number): number[] {
  const [a, b, c, d, e, f] = numbersOf(matrix);
  return [a * x + c * y + e, b * x + d * y + f];
}

test('both ends arrive', () => {
  const matrix = gradientMatrix([10, 20, 40, 60], [100, 50, 60, 80]); // a quarter turn: (30, 40) becomes (-40, 30)
  expect(numbersOf(matrix).slice(0, 4)).toEqual([0, 1, -1, 0]);
  expect(carried(matrix, 10, 20)).toEqual([100, 50]);
  expect(carried(matrix, 40, 60)).toEqual([60, 80]);
});

test('at rest it is the identity', () => {
  expect(numbersOf(gradientMatrix([3, 4, 8, 9], [3, 4, 8, 9]))).toEqual([1, 0, 0, 1, 0, 0]);
});

test('an axis without length is shifted', () => {
  expect(numbersOf(gradientMatrix([5, 5, 5, 5], [7, 4, 7, 4]))).toEqual([1, 0, 0, 1, 2, -1]);
});

test('an axis that collapses keeps an inverse', () => {
  const [a, b, c, d] = numbersOf(gradientMatrix([0, 0, 9, 0], [2, 2, 2, 2]));
  expect(a * d - b * c).toBeGreaterThan(0);
});
