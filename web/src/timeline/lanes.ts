/** Turns a track into the curves that the timeline draws: mouth, lids, brows, gaze, head. */
import type { Track } from '../api/schema';
import { distance, type Xy } from '../face/vector';

export type Lane = { readonly label: string /** One value a frame, 0 to 1. */; readonly values: readonly number[] };

/** How each lane reads articulators: the largest share of any channel's range. */
const CHANNELS_OF_LANE: readonly { readonly label: string; readonly channels: Readonly<Record<string, number>> }[] = [
  { label: 'Mouth', channels: { jaw: 1, round: 1, press: 1, width: 1, upper_raise: 1, lower_raise: 1, smile: 1 } },
  { label: 'Lids', channels: { blink_left: 1, blink_right: 1 } },
  { label: 'Brows', channels: { brow_left: 1, brow_right: 1 } },
  { label: 'Gaze', channels: { gaze_x: 1, gaze_y: 1 } },
  { label: 'Head', channels: { yaw: 20, pitch: 12, roll: 15 } },
];

/** Landmarks whose offset from the track's first frame shows a lane's motion. */
const POINTS_OF_LANE: Readonly<Record<string, readonly number[]>> = {
  Mouth: [62, 66, 48, 54],
  Lids: [37, 41, 44, 46],
  Brows: [19, 24],
  Head: [27],
};

export function lanesOf(track: Track): Lane[] {
  const lanes = CHANNELS_OF_LANE.map(({ label, channels }) => {
    const curves = [articulatorCurve(track, channels), landmarkCurve(track, POINTS_OF_LANE[label])].filter((curve) => curve.length > 0);
    return { label, values: curves.length === 2 ? longer(curves[0], curves[1]) : (curves[0] ?? []) };
  });
  return lanes.filter(({ values }) => values.some((value) => value > 0)).map(({ label, values }) => ({ label, values: thinned(values) }));
}

const MOST_POINTS = 1200; // about what a screen is wide

/** The largest of every few values, so that an hour draws as quickly as a second. */
function thinned(values: readonly number[]): readonly number[] {
  const every = Math.ceil(values.length / MOST_POINTS);
  if (every <= 1) return values;
  return Array.from({ length: Math.ceil(values.length / every) }, (_, k) => Math.max(...values.slice(k * every, (k + 1) * every)));
}

function articulatorCurve({ articulators }: Track, channels: Readonly<Record<string, number>>): number[] {
  const present = Object.entries(channels).filter(([name]) => articulators?.[name]?.length);
  const count = Math.max(0, ...present.map(([name]) => articulators?.[name].length ?? 0));
  return Array.from({ length: count }, (_, frame) =>
    Math.min(1, Math.max(...present.map(([name, range]) => Math.abs(articulators?.[name][frame] ?? 0) / range))),
  );
}

/** Largest offset among the points, the nose bridge's motion taken off, scaled to the track's own maximum. */
function landmarkCurve({ landmarks }: Track, points: readonly number[] | undefined): number[] {
  if (!landmarks || !points) return [];
  const bridge = 27;
  const still: Xy = [0, 0];
  const moved = landmarks.map((frame) =>
    Math.max(...points.map((index) => distance(frame[index], index === bridge ? still : frame[bridge]))),
  );
  const most = Math.max(...moved);
  return most > 1e-4 ? moved.map((value) => value / most) : [];
}

function longer(a: readonly number[], b: readonly number[]): number[] {
  return Array.from({ length: Math.max(a.length, b.length) }, (_, k) => Math.max(a[k] ?? 0, b[k] ?? 0));
}
