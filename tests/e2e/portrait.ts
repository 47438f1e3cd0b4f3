/** A small layered portrait made from numbers, as a `.vtalk` file, so that tests of a finished scene need no optimiser. */
import { expect, type Page } from '@playwright/test';
import { strToU8, zipSync } from 'fflate';
import type { LocalPath, Project, Scene, ScenePath } from '../../web/src/api/schema';
import { SOUND_SECONDS, SYLLABLES, syllablesWav } from './sounds';

const N_SEGMENTS = 6;
const DURATION = 1.2; // seconds
const FPS = 25;

/** A fresh page with the portrait of numbers open, ready to be posed; with another file, that of it. */
export async function openPortraitOfNumbers(page: Page, file = portraitFile()): Promise<void> {
  await page.goto('/');
  const dialog = page.waitForEvent('filechooser');
  await page.getByRole('button', { name: 'Open', exact: true }).click();
  await (await dialog).setFiles({ name: 'numbers.vtalk', mimeType: 'application/zip', buffer: file });
  await expect(page.getByRole('spinbutton', { name: 'Jaw, value' })).toBeEnabled();
}

export function portraitFile(): Buffer {
  return packed(project([nod()]), {});
}

/** The portrait says `transcript` in the syllables of `sounds.ts`. */
export function speakingPortraitFile(transcript: string): Buffer {
  const audio = 'speech-syllables.wav';
  const spoken = {
    ...nod(),
    name: 'Syllables',
    duration: SOUND_SECONDS,
    tier: 'transcript',
    audio,
    visemes: SYLLABLES.map(([start, end]) => ({ t: start, d: end - start, viseme: 'aa', weight: 1 })),
    choices: { transcript, options: { language: 'en' } },
  };
  return packed({ ...project([spoken]), audio }, { [audio]: syllablesWav() });
}

function packed(document: Project, sounds: Record<string, Uint8Array>): Buffer {
  return Buffer.from(zipSync({ 'project.json': strToU8(JSON.stringify(document)), ...sounds }));
}

function project(tracks: Project['tracks']): Project {
  return {
    schema_version: 1,
    name: 'Numbers',
    scene: scene(),
    landmarks: { points: landmarks(), irises: null, depth: null },
    pose: { articulators: {}, offsets: null },
    tracks,
    settings: {},
  };
}

function scene(): Scene {
  const paint = (x: number, y: number, radius: number, colour: string, opacity = 1): ScenePath => ({
    points: blob(x, y, radius),
    fill: { kind: 'solid', colour, opacity },
  });
  const local = (part: LocalPath['part'], x: number, y: number, radius: number, colour: string): LocalPath => ({
    ...paint(x, y, radius, colour),
    part,
  });
  const skin: ScenePath['fill'] = {
    kind: 'linear',
    start: [80, 60],
    end: [160, 240],
    stops: [
      { colour: '#f0c8a8', opacity: 1 },
      { colour: '#a87858', opacity: 0.9 },
    ],
  };
  return {
    width: 240,
    height: 300,
    canvas: '#304050',
    back: [paint(60, 60, 90, '#5080b0')],
    fore: [{ points: blob(120, 150, 95), fill: skin }, paint(75, 170, 24, '#e08080', 0.4), paint(120, 206, 30, '#b04048')],
    local: [
      local('left_eye', 86, 130, 20, '#f8f4f0'),
      local('left_iris', 86, 130, 6, '#304060'),
      local('right_eye', 154, 130, 20, '#f8f4f0'),
      local('right_iris', 154, 130, 6, '#304060'),
      local('mouth_cavity', 120, 210, 40, '#301010'),
    ],
  };
}

function nod(): Project['tracks'][number] {
  const times = Array.from({ length: Math.round(DURATION * FPS) }, (_, frame) => frame / FPS);
  return {
    schema_version: 1,
    name: 'Nod',
    duration: DURATION,
    fps: FPS,
    articulators: { jaw: times.map((t) => Math.abs(Math.sin(9 * t))), roll: times.map((t) => 12 * Math.sin((t / DURATION) * 2 * Math.PI)) },
  };
}

function blob(x: number, y: number, radius: number): number[] {
  return Array.from({ length: 3 * N_SEGMENTS }, (_, i) => (i / (3 * N_SEGMENTS)) * 2 * Math.PI).flatMap((turn) => [
    x + radius * Math.cos(turn),
    y + radius * Math.sin(turn),
  ]);
}

/** A frontal face with closed lips and open eyes, in iBUG order. */
function landmarks(): [number, number][] {
  const along = (count: number, point: (share: number) => [number, number]) =>
    Array.from({ length: count }, (_, i) => point(i / (count - 1)));
  const jaw = along(17, (s) => [120 - 70 * Math.cos(Math.PI * s), 140 + 95 * Math.sin(Math.PI * s)]);
  const brow = (x: number) => along(5, (s) => [x + 36 * s, 112 - 6 * Math.sin(Math.PI * s)]);
  const nose = [...along(4, (s) => [120, 128 + 42 * s]), ...along(5, (s) => [106 + 28 * s, 178])];
  const at = (x: number, y: number, ...offsets: [number, number][]) => offsets.map(([dx, dy]): [number, number] => [x + dx, y + dy]);
  const eye = (x: number) => at(x, 130, [0, 0], [9, -6], [19, -6], [28, 0], [19, 5], [9, 5]);
  const outer = at(
    120,
    205,
    [-30, 0],
    [-20, -6],
    [-8, -9],
    [0, -7],
    [8, -9],
    [20, -6],
    [30, 0],
    [20, 7],
    [8, 11],
    [0, 12],
    [-8, 11],
    [-20, 7],
  );
  const inner = at(120, 205, [-26, 0], [-10, -1], [0, -1], [10, -1], [26, 0], [10, 0], [0, 0], [-10, 0]);
  return [...jaw, ...brow(66), ...brow(138), ...nose, ...eye(72), ...eye(140), ...outer, ...inner];
}
