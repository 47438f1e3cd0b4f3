/**
 * Raw 68-point rows `t,x0,y0,…,x67,y67` of a tracked face become a landmark track. The neutral face is the row whose lips are nearest
 * to closed among those whose eyes are open; offsets from it are in units of its outer-eye distance. Head motion stays in.
 */
import type { Track } from '../api/schema';
import { N_LANDMARKS } from '../face/ibug';
import { outerEyeDistance } from '../face/regions';
import { distance, scale, subtract, type Xy } from '../face/vector';
import { FileError } from '../store/notices';

const COLUMNS = 1 + 2 * N_LANDMARKS;
const MAX_FPS = 240;
const MAX_FRAMES = 100_000; // over an hour at 25 fps
const INNER_LIPS = [
  [61, 67],
  [62, 66],
  [63, 65],
] as const;
const LIDS = [
  [37, 41],
  [38, 40],
  [43, 47],
  [44, 46],
] as const;

type Row = { readonly time: number; readonly points: readonly Xy[] };

export function readPointsCsv(text: string, name: string): Track {
  const rows = rowsOf(text, name);
  const steps = rows.slice(1).map((row, k) => row.time - rows[k].time);
  const fps = Math.min(MAX_FPS, 1 / median(steps));
  const span = rows[rows.length - 1].time - rows[0].time;
  const count = Math.round(span * fps) + 1;
  if (count > MAX_FRAMES) throw new FileError(`${name} lasts ${span} s, ${count} frames; the limit is ${MAX_FRAMES}.`);
  const neutral = neutralOf(rows);
  const unit = outerEyeDistance(neutral);
  if (unit < 1e-6) throw new FileError(`The outer eye corners of ${name} coincide: it holds no face.`);
  const frames = resampled(rows, count, fps);
  const landmarks = frames.map((points) => points.map((point, k) => scale(subtract(point, neutral[k]), 1 / unit)));
  return { schema_version: 1, name, duration: count / fps, fps, landmarks };
}

function rowsOf(text: string, name: string): Row[] {
  const lines = text.split(/\r?\n/).filter((line) => line.trim() !== '');
  const hasNames = lines.length > 0 && Number.isNaN(Number.parseFloat(lines[0]));
  const rows = lines.slice(hasNames ? 1 : 0).map((line, k) => rowOf(line, k + 1, name));
  if (rows.length < 2) throw new FileError(`${name} has ${rows.length} rows; a track needs 2.`);
  if (rows.some((row, k) => k > 0 && row.time <= rows[k - 1].time)) throw new FileError(`The times of ${name} do not ascend.`);
  return rows;
}

function rowOf(line: string, number: number, name: string): Row {
  const values = line.split(',').map(Number);
  if (values.length !== COLUMNS)
    throw new FileError(`Row ${number} of ${name} has ${values.length} columns; t,x0,y0,…,x67,y67 are ${COLUMNS}.`);
  const bad = values.findIndex((value) => !Number.isFinite(value));
  if (bad >= 0) throw new FileError(`Row ${number} of ${name} has no finite number in column ${bad + 1}.`);
  return { time: values[0], points: Array.from({ length: N_LANDMARKS }, (_, k): Xy => [values[1 + 2 * k], values[2 + 2 * k]]) };
}

/** Frames at even steps of 1 / fps, linear between rows. */
function resampled(rows: readonly Row[], count: number, fps: number): Xy[][] {
  let before = 0;
  return Array.from({ length: count }, (_, frame) => {
    const time = rows[0].time + frame / fps;
    while (before < rows.length - 2 && rows[before + 1].time <= time) before += 1;
    const [a, b] = [rows[before], rows[before + 1]];
    const share = Math.min(1, (time - a.time) / (b.time - a.time));
    return a.points.map(([x, y], k): Xy => [x + (b.points[k][0] - x) * share, y + (b.points[k][1] - y) * share]);
  });
}

function neutralOf(rows: readonly Row[]): readonly Xy[] {
  const eyes = rows.map(({ points }) => gap(points, LIDS));
  const open = median(eyes);
  const candidates = rows.filter((_, k) => eyes[k] >= open);
  return candidates.reduce((best, row) => (gap(row.points, INNER_LIPS) < gap(best.points, INNER_LIPS) ? row : best)).points;
}

function gap(points: readonly Xy[], couples: readonly (readonly [number, number])[]): number {
  return couples.reduce((sum, [a, b]) => sum + distance(points[a], points[b]), 0) / couples.length;
}

function median(values: readonly number[]): number {
  const sorted = [...values].sort((a, b) => a - b);
  const middle = sorted.length / 2;
  return (sorted[Math.ceil(middle) - 1] + sorted[Math.floor(middle)]) / 2;
}
