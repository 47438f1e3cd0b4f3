import { expect, test } from 'vitest';
import type { Scene, Track } from '../api/schema';
import { evenSize } from './canvas';
import { cssColour, drawingOf } from './drawing';
import { forecastText } from './forecast';
import { bakedTrack } from './motion';

const TRACK: Track = { schema_version: 1, name: 'Jaw', duration: 0.2, fps: 10, articulators: { jaw: [0, 0.5] }, landmarks: null };

test('video sizes are even and keep the picture whole', () => {
  expect(evenSize({ width: 512, height: 600 }, 512)).toEqual({ width: 436, height: 512 }); // 436.9 × 512
  expect(evenSize({ width: 1000, height: 1 }, 360)).toEqual({ width: 360, height: 2 });
});

test('the standing pose is added to every frame of a baked track', () => {
  const offsets = Array.from({ length: 68 }, (): [number, number] => [0, 0.25]);
  const baked = bakedTrack({ pose: { articulators: { smile: 0.3, jaw: 0.1 }, offsets }, track: TRACK });
  expect(baked.articulators).toEqual({ neutral: [0, 0], jaw: [0.1, 0.6], smile: [0.3, 0.3] });
  expect(baked.landmarks).toEqual([offsets, offsets]);
});

test('a portrait at rest bakes to the track itself', () => {
  expect(bakedTrack({ pose: { articulators: {}, offsets: null }, track: TRACK })).toBe(TRACK);
});

test('forecasts are rounded for people', () => {
  expect(forecastText({ bytes: 1_440_000, seconds: 2.6 })).toBe('about 1.4 MB, 3 s');
  expect(forecastText({ bytes: 71_400, seconds: 0.2 })).toBe('about 71 kB, under a second');
});

test('fills become thirteen numbers a path, three stops even of old ones with two, clips an opening a local path', () => {
  const points = Array.from({ length: 12 }, () => 0);
  const red = { colour: '#ff0000', opacity: 0.5 };
  const scene: Scene = {
    width: 4,
    height: 3,
    canvas: '#010203',
    back: [{ points, fill: { kind: 'solid', ...red } }],
    fore: [{ points, fill: { kind: 'linear', start: [1, 2], end: [3, 4], stops: [red, { colour: '#0000ff', opacity: 1 }] } }],
    local: [{ points, part: 'tongue', fill: { kind: 'solid', ...red } }],
  };
  const { core, openings } = drawingOf(scene);
  const solid = [255, 0, 0, 0.5];
  const linear = [...solid, 127.5, 0, 127.5, 0.75, 0, 0, 255, 1];
  expect(Array.from(core.fills.subarray(0, 26))).toEqual([0, ...solid, ...solid, ...solid, 1, ...linear]);
  expect(Array.from(core.axes)).toEqual([0, 0, 0, 0, 1, 2, 3, 4, 0, 0, 0, 0]);
  expect(openings).toEqual([null, null, 2]);
  expect(cssColour(red)).toBe('rgb(255 0 0 / 0.5)');
});
