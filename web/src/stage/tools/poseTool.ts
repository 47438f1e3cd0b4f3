/** The pose tool: drags landmarks of the present pose, or the articulator of the part that was grabbed. */
import { landmarkName, mirrorOf } from '../../face/ibug';
import { articulate, outerEyeDistance, REGION_CHANNELS, REGION_HINTS, regionAt } from '../../face/regions';
import { pressedRadius, type Reach, softDrag } from '../../face/softDrag';
import { rotate, scale, subtract, type Xy } from '../../face/vector';
import { type Edit, withArticulators, withOffsetsAdded, withoutChannels, withoutOffsets } from '../../store/edit';
import type { Held } from '../held';
import { NOTHING, type Outcome, type Press, type Start, type Target, type Tool } from './gesture';
import { nearestPoint } from './nearest';

export type PoseSurroundings = {
  /** The 68 landmarks as they stand on the stage, in portrait pixels. */
  readonly points: () => readonly Xy[];
  /** Screen pixels per portrait pixel. */
  readonly scale: () => number;
  readonly handlesShown: () => boolean;
  /** Falloff in outer-eye distances. */
  readonly softRadius: () => number;
  readonly single: () => boolean;
  readonly mirrored: () => boolean;
  readonly pan: Tool;
};

export function poseTool(around: PoseSurroundings): Tool {
  return {
    aim: (press) => aim(press, around),
    drag: (target, start, from, to) => drag(target, start, from, to, around),
    click: () => NOTHING,
    reset: (target, { edit }) => reset(target, edit, around),
    hint: (target) => hint(target, around),
  };
}

function aim(press: Press, around: PoseSurroundings): Target {
  const index = around.handlesShown() ? nearestPoint(around.points(), press.portrait, around.scale()) : null;
  if (index !== null) return { kind: 'landmark', index };
  const region = regionAt(around.points(), press.portrait);
  return region ? { kind: 'region', region } : { kind: 'canvas' };
}

function drag(target: Target, start: Start, from: Press, to: Press, around: PoseSurroundings): Outcome {
  const rest = start.edit.landmarks?.points;
  if (target.kind === 'canvas' || !rest) return around.pan.drag(target, start, from, to);
  const moved = subtract(to.portrait, from.portrait);
  if (target.kind === 'landmark') return { kind: 'sketch', edit: dragLandmark(start.edit, target.index, rest, moved, to, around) };
  if (target.kind === 'iris') return NOTHING;
  const articulators = articulate(start.edit.pose.articulators, target.region, moved, outerEyeDistance(rest), to.shift);
  return { kind: 'sketch', edit: withArticulators(start.edit, articulators) };
}

/** `edit` with landmark `index` moved by `moved` portrait pixels on the stage. Offsets turn with the head, so the drag turns back. */
export function dragLandmark(edit: Edit, index: number, rest: readonly Xy[], moved: Xy, held: Held, around: Reaching): Edit {
  const roll = ((edit.pose.articulators.roll ?? 0) * Math.PI) / 180;
  const unit = outerEyeDistance(rest);
  const drag = scale(rotate(moved, -roll), 1 / unit);
  return withOffsetsAdded(edit, softDrag(rest, index, drag, reachOf(unit, held, around)));
}

export type Reaching = Pick<PoseSurroundings, 'softRadius' | 'single' | 'mirrored'>;

/** `unit`: the outer-eye distance in portrait pixels, in which the reach is. */
export function reachOf(unit: number, { alt, pressure }: Held, around: Reaching): Reach {
  const radius = pressedRadius(around.softRadius() * unit, pressure);
  return { radius, single: alt || around.single(), mirrored: around.mirrored() };
}

function reset(target: Target, edit: Edit, around: PoseSurroundings): Outcome {
  switch (target.kind) {
    case 'landmark': {
      const indices = around.mirrored() ? [target.index, mirrorOf(target.index)] : [target.index];
      return { kind: 'sketch', edit: withoutOffsets(edit, indices) };
    }
    case 'region':
      return { kind: 'sketch', edit: withoutChannels(edit, REGION_CHANNELS[target.region]) };
    case 'iris':
    case 'canvas':
      return NOTHING;
    default: {
      const unknown: never = target;
      throw new RangeError(`Unknown target ${unknown}`);
    }
  }
}

function hint(target: Target | null, around: PoseSurroundings): string {
  if (target?.kind === 'landmark') return `${landmarkName(target.index)}: drag, with Alt alone${around.mirrored() ? ', mirrored' : ''}`;
  if (target?.kind === 'region') return REGION_HINTS[target.region];
  return 'Drag a point, or the mouth, eyes, brows, jaw or head';
}
