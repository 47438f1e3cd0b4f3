/**
 * Edits of a viseme track: pure functions from blocks to blocks. Blocks are in order and never overlap; neighbours that touch keep
 * touching, so that a retimed block takes the time from its neighbour. Times are seconds.
 */
import type { VisemeBlock } from '../api/schema';
import type { Viseme } from './visemes';

export type Block = Readonly<VisemeBlock>;
export type Blocks = readonly Block[];
export type Edge = 'start' | 'end';

/** As short as the server's decoder makes them: a mouth is no quicker. */
export const LEAST_SECONDS = 0.04;
const NEW_SECONDS = 0.12;
const TOUCHING = 2e-3; // times are rounded to milliseconds

export const endOf = ({ t, d }: Block): number => t + d;

/** The number of the block at `time`; -1 in a gap. */
export function blockAt(blocks: Blocks, time: number): number {
  return blocks.findIndex((block) => block.t <= time && time < endOf(block));
}

/** The block carried to `start`, as far as its neighbours leave room; touching neighbours follow. */
export function moved(blocks: Blocks, index: number, start: number, duration: number): Blocks {
  const block = blocks[index];
  const [least, most] = room(blocks, index, duration);
  const t = within(start, least, Math.max(least, most - block.d));
  return placed(blocks, index, t, t + block.d);
}

/** One edge of the block carried to `time`. */
export function retimed(blocks: Blocks, index: number, edge: Edge, time: number, duration: number): Blocks {
  const block = blocks[index];
  const [least, most] = room(blocks, index, duration);
  return edge === 'start'
    ? placed(blocks, index, within(time, least, endOf(block) - LEAST_SECONDS), endOf(block))
    : placed(blocks, index, block.t, within(time, block.t + LEAST_SECONDS, most));
}

export function changed(blocks: Blocks, index: number, viseme: Viseme): Blocks {
  return blocks.map((block, k) => (k === index ? { ...block, viseme, weight: 1 } : block));
}

/** A new block round `time`: cut out of the block there, or filling the gap. The same blocks where there is no room. */
export function added(blocks: Blocks, time: number, viseme: Viseme, duration: number): Blocks {
  const under = blockAt(blocks, time);
  const [from, to] = under >= 0 ? [blocks[under].t, endOf(blocks[under])] : gapAt(blocks, time, duration);
  if (to - from < LEAST_SECONDS) return blocks;
  const d = Math.min(NEW_SECONDS, to - from);
  const t = within(time - d / 2, from, to - d);
  const rests = under >= 0 ? [cut(blocks[under], from, t), cut(blocks[under], t + d, to)] : [];
  const others = blocks.filter((_, k) => k !== under);
  const next = [...others, ...rests.filter((rest) => rest !== null), { t, d, viseme, weight: 1 }].sort((a, b) => a.t - b.t);
  return joined(
    next,
    next.findIndex((block) => block.t === t),
  );
}

/** Without the block; a touching neighbour takes its time, the one before it first. */
export function removed(blocks: Blocks, index: number): Blocks {
  const block = blocks[index];
  const before = blocks[index - 1];
  const after = blocks[index + 1];
  const heir = before && touch(before, block) ? before : after && touch(block, after) ? after : null;
  const grown = heir === before && before ? spanning(before, before.t, endOf(block)) : after && spanning(after, block.t, endOf(after));
  return blocks.filter((_, k) => k !== index).map((other) => (other === heir && grown ? grown : other));
}

/** The earliest start and the latest end that neighbours leave: they keep their least length. */
function room(blocks: Blocks, index: number, duration: number): readonly [number, number] {
  const before = blocks[index - 1];
  const after = blocks[index + 1];
  return [before ? before.t + LEAST_SECONDS : 0, after ? endOf(after) - LEAST_SECONDS : duration];
}

/** Block `index` from `start` to `end`; its neighbours give way, and follow if they touched it. */
function placed(blocks: Blocks, index: number, start: number, end: number): Blocks {
  const block = blocks[index];
  const before = blocks[index - 1];
  const after = blocks[index + 1];
  return blocks.map((other, k) => {
    if (k === index) return spanning(block, start, end);
    if (k === index - 1 && (touch(before, block) || endOf(before) > start)) return spanning(before, before.t, start);
    if (k === index + 1 && (touch(block, after) || after.t < end)) return spanning(after, end, endOf(after));
    return other;
  });
}

/** Scraps too short for a mouth, left of a cut block, are given to block `index`. */
function joined(blocks: Blocks, index: number): Blocks {
  const block = blocks[index];
  const before = blocks[index - 1];
  const after = blocks[index + 1];
  const isScrap = (other: Block | undefined): other is Block => other !== undefined && other.d < LEAST_SECONDS - TOUCHING;
  const start = isScrap(before) && touch(before, block) ? before.t : block.t;
  const end = isScrap(after) && touch(block, after) ? endOf(after) : endOf(block);
  const swallowed = [start < block.t ? before : null, end > endOf(block) ? after : null];
  return blocks.filter((other) => !swallowed.includes(other)).map((other) => (other === block ? spanning(block, start, end) : other));
}

function gapAt(blocks: Blocks, time: number, duration: number): readonly [number, number] {
  const from = Math.max(0, ...blocks.filter((block) => endOf(block) <= time).map(endOf));
  return [from, Math.min(duration, ...blocks.filter(({ t }) => t > time).map(({ t }) => t))];
}

const cut = (block: Block, start: number, end: number): Block | null => (end - start > TOUCHING ? spanning(block, start, end) : null);
const spanning = (block: Block, start: number, end: number): Block => ({ ...block, t: start, d: end - start });
const touch = (a: Block, b: Block): boolean => Math.abs(endOf(a) - b.t) < TOUCHING;
const within = (value: number, least: number, most: number): number => Math.min(Math.max(value, least), most);
