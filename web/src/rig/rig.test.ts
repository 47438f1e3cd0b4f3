import { readFileSync } from 'node:fs';
import { beforeAll, describe, expect, test } from 'vitest';
import type { Landmarks, Pose, Scene } from '../api/schema';
import { buildRig, fitPins, loadRigModule, type Pins } from './rig';

type Vectors = {
  scene: Scene;
  pins: Pins;
  landmarks: Landmarks;
  frames: { pose: Pose; scale: number; vertices: number[]; changed: Record<string, number[]> }[];
};

const TOLERANCE = 1e-6; // px; the numbers are written to 1e-9
const REST: Pose = { articulators: {} };
const vectors: Vectors = JSON.parse(readFileSync(new URL('../../../tests/vectors/rig/face.json', import.meta.url), 'utf8'));
const N_PATHS = vectors.scene.back.length + vectors.scene.fore.length + vectors.scene.local.length;
const SOLID = new Float64Array(4 * N_PATHS); // no path has a gradient

beforeAll(() => loadRigModule(readFileSync(new URL('./wasm/vectortalker_browser_bg.wasm', import.meta.url))));

function expectNear(actual: ArrayLike<number>, expected: readonly number[]): void {
  expect(actual.length).toBe(expected.length);
  const worst = expected.reduce((most, value, index) => Math.max(most, Math.abs(value - actual[index])), 0);
  expect(worst).toBeLessThan(TOLERANCE);
}

describe('the vectors that Python and Rust give', () => {
  test.each(vectors.frames.map((_, index) => index))('frame %i', (index) => {
    const expected = vectors.frames[index];
    const rig = buildRig(vectors.scene, vectors.landmarks);
    const { vertices, limit } = rig.vertices(expected.pose);
    expect(limit.scale).toBeCloseTo(expected.scale, 12);
    expectNear(vertices, expected.vertices);
    const moved = rig.movedPoints(vertices, SOLID);
    expect(moved.map(({ path }) => String(path))).toEqual(Object.keys(expected.changed));
    for (const { path, points } of moved) expectNear(points, expected.changed[path]);
  });

  test('pins', () => expectNear(fitPins(vectors.pins)?.points.flat() ?? [], vectors.landmarks.points.flat()));
});

test('a frame lists what differs from the frame before', () => {
  const rig = buildRig(vectors.scene, vectors.landmarks);
  const open = rig.vertices({ articulators: { jaw: 1 } }).vertices;
  const opened = rig.frame(open, SOLID);
  expect(opened.changed.length).toBeGreaterThan(0);
  expect(rig.frame(open, SOLID).changed).toHaveLength(0);
  expect(rig.frame(rig.restVertices, SOLID).changed).toEqual(opened.changed);
});

test('path data of paths that never move is the scene’s own, and returns to it with the rest', () => {
  const rig = buildRig(vectors.scene, vectors.landmarks);
  const before = Array.from({ length: rig.pathCount }, (_, path) => rig.frame(rig.restVertices, SOLID).d(path));
  const frame = rig.frame(rig.vertices({ articulators: { jaw: 1, yaw: 10 } }).vertices, SOLID);
  expect(frame.d(0)).toBe(before[0]);
  expect(frame.d(1)).not.toBe(before[1]);
  expect(frame.d(1).replace(/[-\d. ]+/g, '')).toBe(before[1].replace(/[-\d. ]+/g, ''));
  const rest = rig.frame(rig.vertices(REST).vertices, SOLID);
  expect(before.map((_, path) => rest.d(path))).toEqual(before);
});

test('openings come as path data and the mouth is empty after a press', () => {
  const rig = buildRig(vectors.scene, vectors.landmarks);
  const openings = rig.openings(rig.vertices({ articulators: { press: 1 } }).vertices);
  expect(openings).toHaveLength(3);
  expect(openings[2]).toMatch(/^M.*Z$/);
});

test('landmarks without extent are refused with the core’s message', () => {
  const points = Array.from({ length: 68 }, (): [number, number] => [5, 5]);
  expect(() => buildRig(vectors.scene, { points })).toThrow(/bad_landmarks: outer eye corners are 0.00 px/);
});

test('coinciding pins fit nothing', () => {
  expect(
    fitPins([
      [3, 4],
      [3, 4],
      [3, 4],
      [3, 4],
      [3, 4],
    ]),
  ).toBeNull();
});
