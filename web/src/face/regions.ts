/** Finds what part of a face lies under a point, and what dragging it there means. */
import type { Articulators } from '../store/edit';
import { clampChannel } from './channels';
import { type GroupName, groupNamed, indicesOf, OUTER_EYE_CORNERS } from './ibug';
import { add, centroid, distance, enlarged, isInside, scale, type Xy } from './vector';

export type Region = 'left_gaze' | 'right_gaze' | 'left_lid' | 'right_lid' | 'left_brow' | 'right_brow' | 'mouth' | 'jaw' | 'head';

/** What the stage says while the pointer rests on a region. */
export const REGION_HINTS: Readonly<Record<Region, string>> = {
  left_gaze: 'Eyes: drag to look around',
  right_gaze: 'Eyes: drag to look around',
  left_lid: 'Left lid: drag down to close',
  right_lid: 'Right lid: drag down to close',
  left_brow: 'Left brow: drag up or down',
  right_brow: 'Right brow: drag up or down',
  mouth: 'Mouth: drag down to open, sideways to widen',
  jaw: 'Jaw: drag down to open',
  head: 'Head: drag to turn and nod, with Shift to tilt',
};

const EYE_GROWTH = 1.35; // a lid is grabbed just above its edge
const LIP_GROWTH = 1.1;
const BROW_GROWTH = 1.25;
const BROW_HALF_HEIGHT = 0.09; // of the outer-eye distance
const IRIS_RADIUS = 0.09; // of the outer-eye distance
const HEAD_GROWTH = 1.12;
const FOREHEAD_HEIGHT = 0.55; // above the brows, of the outer-eye distance

/** The region under `p`, foremost first, or null outside the head. `points`: the 68 landmarks as they stand now. */
export function regionAt(points: readonly Xy[], p: Xy): Region | null {
  const eyeDistance = outerEyeDistance(points);
  const polygon = (name: GroupName): Xy[] => indicesOf(groupNamed(name)).map((index) => points[index]);
  for (const side of ['left', 'right'] as const) {
    const eye = polygon(`${side}_eye`);
    if (distance(p, centroid(eye)) < IRIS_RADIUS * eyeDistance && isInside(p, eye)) return `${side}_gaze`;
    if (isInside(p, enlarged(eye, EYE_GROWTH))) return `${side}_lid`;
  }
  if (isInside(p, enlarged(polygon('outer_lips'), LIP_GROWTH))) return 'mouth';
  for (const side of ['left', 'right'] as const) {
    if (isInside(p, thickened(enlarged(polygon(`${side}_brow`), BROW_GROWTH), BROW_HALF_HEIGHT * eyeDistance))) return `${side}_brow`;
  }
  if (!isInside(p, headOutline(points, eyeDistance))) return null;
  return p[1] > centroid(polygon('outer_lips'))[1] ? 'jaw' : 'head';
}

/** Distance of the outer eye corners, the unit of offsets. */
export function outerEyeDistance(points: readonly Xy[]): number {
  const [left, right] = OUTER_EYE_CORNERS;
  return distance(points[left], points[right]);
}

function headOutline(points: readonly Xy[], eyeDistance: number): Xy[] {
  const jaw = indicesOf(groupNamed('jaw')).map((index) => points[index]);
  const forehead = [26, 24, 19, 17].map((index) => add(points[index], [0, -FOREHEAD_HEIGHT * eyeDistance]));
  return enlarged([...jaw, ...forehead], HEAD_GROWTH);
}

function thickened(line: readonly Xy[], halfHeight: number): Xy[] {
  return [...line.map((p) => add(p, [0, -halfHeight])), ...[...line].reverse().map((p) => add(p, [0, halfHeight]))];
}

// Full range of a channel per outer-eye distance dragged: a lid shuts over a quarter of it, a head turns over three quarters.
const LID_TRAVEL = 0.25;
const GAZE_TRAVEL = 0.12;
const BROW_TRAVEL = 0.25;
const JAW_TRAVEL = 0.45;
const WIDTH_TRAVEL = 0.35;
const DEGREES_PER_EYE_DISTANCE = 30;

/**
 * The articulators after dragging a region by `drag` (portrait pixels). `tilt`: turn a head drag into a tilt.
 * Start values come from `start`, so that a drag is repeatable from any pose.
 */
export function articulate(start: Articulators, region: Region, drag: Xy, eyeDistance: number, tilt: boolean): Articulators {
  const [dx, dy] = scale(drag, 1 / eyeDistance);
  switch (region) {
    case 'left_gaze':
    case 'right_gaze':
      return moved(start, { gaze_x: dx / GAZE_TRAVEL, gaze_y: dy / GAZE_TRAVEL });
    case 'left_lid':
      return moved(start, { blink_left: dy / LID_TRAVEL });
    case 'right_lid':
      return moved(start, { blink_right: dy / LID_TRAVEL });
    case 'left_brow':
      return moved(start, { brow_left: -dy / BROW_TRAVEL });
    case 'right_brow':
      return moved(start, { brow_right: -dy / BROW_TRAVEL });
    case 'mouth':
      return moved(start, { jaw: dy / JAW_TRAVEL, width: dx / WIDTH_TRAVEL });
    case 'jaw':
      return moved(start, { jaw: dy / JAW_TRAVEL });
    case 'head':
      return moved(
        start,
        tilt ? { roll: dx * DEGREES_PER_EYE_DISTANCE } : { yaw: dx * DEGREES_PER_EYE_DISTANCE, pitch: dy * DEGREES_PER_EYE_DISTANCE },
      );
    default: {
      const unknown: never = region;
      throw new RangeError(`Unknown region ${unknown}`);
    }
  }
}

/** The channels a double-click on a region sets back to rest. */
export const REGION_CHANNELS: Readonly<Record<Region, readonly string[]>> = {
  left_gaze: ['gaze_x', 'gaze_y'],
  right_gaze: ['gaze_x', 'gaze_y'],
  left_lid: ['blink_left'],
  right_lid: ['blink_right'],
  left_brow: ['brow_left'],
  right_brow: ['brow_right'],
  mouth: ['jaw', 'width', 'round', 'smile', 'upper_raise', 'lower_raise', 'press', 'tongue_tip'],
  jaw: ['jaw'],
  head: ['yaw', 'pitch', 'roll'],
};

function moved(start: Articulators, change: Articulators): Articulators {
  const entries = Object.entries(change).map(([name, delta]) => [name, clampChannel(name, (start[name] ?? 0) + delta)] as const);
  return { ...start, ...Object.fromEntries(entries) };
}
