/** What keys do to the block in focus. */

import { carried, type Grip } from './blockDrag';
import { added, type Blocks, endOf, LEAST_SECONDS, removed } from './blocks';

const STEP_SECONDS = 0.02; // a frame of speech tracks

export type KeyResult = { readonly blocks: Blocks; readonly selected: number };

/** As listed in the shortcut sheet. */
export const BLOCK_KEYS: readonly (readonly [string, string])[] = [
  ['← →', 'Previous, next viseme'],
  ['Shift ← →', 'Earlier, later'],
  ['Ctrl ← →', 'End earlier, later'],
  ['Ctrl Shift ← →', 'Start earlier, later'],
  ['Insert', 'New viseme in its middle'],
  ['Delete', 'Remove it'],
];

/** Null for keys that mean nothing here. */
export function blockKey(
  { key, shiftKey, ctrlKey, metaKey }: Pick<KeyboardEvent, 'key' | 'shiftKey' | 'ctrlKey' | 'metaKey'>,
  blocks: Blocks,
  index: number,
  duration: number,
): KeyResult | null {
  const block = blocks[index];
  if (!block) return null;
  if (key === 'ArrowLeft' || key === 'ArrowRight') {
    const direction = key === 'ArrowLeft' ? -1 : 1;
    const isMod = ctrlKey || metaKey;
    if (!isMod && !shiftKey) return { blocks, selected: Math.min(Math.max(index + direction, 0), blocks.length - 1) };
    const part: Grip['part'] = !isMod ? 'middle' : shiftKey ? 'start' : 'end';
    return { blocks: carried(blocks, { index, part }, direction * STEP_SECONDS, duration), selected: index };
  }
  if (key === 'Delete' || key === 'Backspace') return { blocks: removed(blocks, index), selected: Math.max(0, index - 1) };
  if (key === 'Insert') {
    const next = added(blocks, block.t + block.d / 2, 'aa', duration);
    const inserted = next.findIndex(({ t, viseme }) => viseme === 'aa' && t >= block.t && t < endOf(block) + LEAST_SECONDS);
    return { blocks: next, selected: inserted < 0 ? index : inserted };
  }
  return null;
}
