/** What a pointer holds of a block, and where it carries it. */
import { type Blocks, blockAt, type Edge, endOf, moved, retimed } from './blocks';

export type Grip = { readonly index: number; readonly part: Edge | 'middle' };

const EDGE_PIXELS = 5;
const EDGE_SHARE = 0.3; // of short blocks, so that their middle can still be held

/** The block under `time` and the part of it; null in a gap. */
export function gripAt(blocks: Blocks, time: number, secondsPerPixel: number): Grip | null {
  const index = blockAt(blocks, time);
  if (index < 0) return null;
  const block = blocks[index];
  const reach = Math.min(EDGE_PIXELS * secondsPerPixel, EDGE_SHARE * block.d);
  if (time - block.t < reach) return { index, part: 'start' };
  return { index, part: endOf(block) - time < reach ? 'end' : 'middle' };
}

export function carried(blocks: Blocks, { index, part }: Grip, bySeconds: number, duration: number): Blocks {
  const block = blocks[index];
  if (part === 'middle') return moved(blocks, index, block.t + bySeconds, duration);
  return retimed(blocks, index, part, (part === 'start' ? block.t : endOf(block)) + bySeconds, duration);
}
