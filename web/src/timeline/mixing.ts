/** Puts poses on top of each other. */
import type { Pose } from '../api/schema';
import { clampChannel } from '../face/channels';
import { add, type Xy } from '../face/vector';
import { offsetsOf } from '../store/edit';

/** The sum of two poses; articulators stay within their ranges. */
export function mixed(a: Pose, b: Pose): Pose {
  const names = new Set([...Object.keys(a.articulators), ...Object.keys(b.articulators)]);
  const articulators = [...names].map(
    (name) => [name, clampChannel(name, (a.articulators[name] ?? 0) + (b.articulators[name] ?? 0))] as const,
  );
  const offsets = a.offsets && b.offsets ? sums(offsetsOf(a), offsetsOf(b)) : (a.offsets ?? b.offsets);
  return { articulators: Object.fromEntries(articulators), offsets };
}

const sums = (a: readonly Xy[], b: readonly Xy[]): Xy[] => a.map((offset, index) => add(offset, b[index]));
