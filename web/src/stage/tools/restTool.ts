/** The tool that corrects a detection: drags rest landmarks and irises; the rig is rebuilt when they are let go. */
import type { Landmarks } from '../../api/schema';
import { landmarkName, mirrorOf } from '../../face/ibug';
import { outerEyeDistance } from '../../face/regions';
import { softDrag } from '../../face/softDrag';
import { add, subtract, type Xy } from '../../face/vector';
import { type Edit, withLandmarks } from '../../store/edit';
import type { Held } from '../held';
import { NOTHING, type Outcome, type Press, type Start, type Target, type Tool } from './gesture';
import { nearestPoint } from './nearest';
import { type Reaching, reachOf } from './poseTool';

export type RestSurroundings = Reaching & {
  readonly landmarks: () => Landmarks | null;
  /** The landmarks as they were detected, for resets. */
  readonly detected: () => Landmarks | null;
  readonly scale: () => number;
  readonly pan: Tool;
};

export function restTool(around: RestSurroundings): Tool {
  return {
    aim: (press) => aim(press, around),
    drag: (target, start, from, to) => drag(target, start, from, to, around),
    click: () => NOTHING,
    reset: (target, { edit }) => reset(target, edit, around),
    hint,
  };
}

function aim(press: Press, around: RestSurroundings): Target {
  const landmarks = around.landmarks();
  if (!landmarks) return { kind: 'canvas' };
  const index = nearestPoint(landmarks.points, press.portrait, around.scale());
  if (index !== null) return { kind: 'landmark', index };
  const iris = nearestPoint(landmarks.irises?.map(({ centre }) => centre) ?? [], press.portrait, around.scale());
  return iris === null ? { kind: 'canvas' } : { kind: 'iris', index: iris === 0 ? 0 : 1 };
}

function drag(target: Target, start: Start, from: Press, to: Press, around: RestSurroundings): Outcome {
  const moved = subtract(to.portrait, from.portrait);
  if (target.kind === 'landmark') return { kind: 'sketch', edit: correctLandmark(start.edit, target.index, moved, to, around) };
  if (target.kind === 'iris') return { kind: 'sketch', edit: correctIris(start.edit, target.index, moved) };
  return around.pan.drag(target, start, from, to);
}

/** `edit` with rest landmark `index` moved by `moved` portrait pixels. */
export function correctLandmark(edit: Edit, index: number, moved: Xy, held: Held, around: Reaching): Edit {
  const landmarks = edit.landmarks;
  if (!landmarks) return edit;
  const reach = reachOf(outerEyeDistance(landmarks.points), held, around);
  const displacements = softDrag(landmarks.points, index, moved, reach);
  return withLandmarks(edit, { ...landmarks, points: landmarks.points.map((point, k) => add(point, displacements[k])) });
}

export function correctIris(edit: Edit, index: 0 | 1, moved: Xy): Edit {
  const irises = edit.landmarks?.irises;
  if (!edit.landmarks || !irises) return edit;
  const corrected = { ...irises[index], centre: add(irises[index].centre, moved) };
  return withLandmarks(edit, { ...edit.landmarks, irises: index === 0 ? [corrected, irises[1]] : [irises[0], corrected] });
}

function reset(target: Target, edit: Edit, around: RestSurroundings): Outcome {
  const detected = around.detected();
  const landmarks = edit.landmarks;
  if (!detected || !landmarks) return NOTHING;
  if (target.kind === 'landmark') {
    const indices = around.mirrored() ? [target.index, mirrorOf(target.index)] : [target.index];
    const points = landmarks.points.map((point, k) => (indices.includes(k) ? detected.points[k] : point));
    return { kind: 'sketch', edit: withLandmarks(edit, { ...landmarks, points }) };
  }
  if (target.kind === 'iris') return { kind: 'sketch', edit: withLandmarks(edit, { ...landmarks, irises: detected.irises }) };
  return NOTHING;
}

function hint(target: Target | null): string {
  if (target?.kind === 'landmark') return `${landmarkName(target.index)}: drag to where it belongs, with Alt alone`;
  if (target?.kind === 'iris') return 'Iris: drag to its centre';
  return 'Drag points to where they belong on the portrait';
}
