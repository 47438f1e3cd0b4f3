/** How far a drag of a landmark reaches: what the stage's options say. */
import { mirrored, singlePoint, softRadius } from '../store/state';
import type { Reaching } from './tools/poseTool';

export const REACH: Reaching = {
  softRadius: () => softRadius.value,
  single: () => singlePoint.value,
  mirrored: () => mirrored.value,
};
