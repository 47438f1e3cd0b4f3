/** The blocks of the shown part: dragged by the middle or an edge, added by a double click, or worked by keyboard. */

import { useComputed, useSignal } from '@preact/signals';
import type { JSX } from 'preact';
import { useRef } from 'preact/hooks';
import type { Span } from '../api/schema';
import { canPose, track } from '../store/state';
import { carried, type Grip, gripAt } from './blockDrag';
import { blockKey } from './blockKeys';
import { added, type Block, type Blocks, blockAt, endOf } from './blocks';
import { editBlocks } from './retracking';
import { blocks, selectedIndex } from './state';
import { reveal, shareOf, shownSpan, timeAt } from './stripView';
import { SOUNDS, type Viseme } from './visemes';

const DRAG_PIXELS = 3; // less is a click
const VOWELS: readonly Viseme[] = ['aa', 'E', 'I', 'O', 'U'];

type Drag = { readonly grip: Grip; readonly clientX: number; readonly from: Blocks };

export function VisemeLane(): JSX.Element {
  const sketched = useSignal<Blocks | null>(null);
  const drag = useRef<Drag | null>(null);
  const shown = useComputed(() => sketched.value ?? blocks.value ?? []);
  const inWindow = useComputed(() => shown.value.flatMap((block, index) => (meets(block, shownSpan.value) ? [{ block, index }] : [])));
  const duration = track.value?.duration ?? 0;
  const drop = () => {
    drag.current = null;
    sketched.value = null;
  };
  return (
    <fieldset
      class="viseme-lane"
      aria-label="Visemes"
      onPointerDown={(event) => {
        const box = event.currentTarget.getBoundingClientRect();
        const grip = gripAt(shown.value, timeAt(event.clientX, box, shownSpan.value), secondsPerPixel(box));
        if (!grip || !canPose.value) return;
        event.currentTarget.setPointerCapture(event.pointerId);
        drag.current = { grip, clientX: event.clientX, from: shown.value };
        select(grip.index, shown.value);
      }}
      onPointerMove={(event) => {
        const started = drag.current;
        if (!started || (!sketched.value && Math.abs(event.clientX - started.clientX) < DRAG_PIXELS)) return;
        const by = (event.clientX - started.clientX) * secondsPerPixel(event.currentTarget.getBoundingClientRect());
        sketched.value = carried(started.from, started.grip, by, duration);
      }}
      onPointerUp={() => {
        if (sketched.value) editBlocks(sketched.value);
        drop();
      }}
      onPointerCancel={drop}
      onKeyDown={(event) => {
        if (event.key === 'Escape' && drag.current) return drop();
        const selected = selectedIndex.value;
        if (selected === null || !canPose.value) return;
        const next = blockKey(event, shown.value, selected, duration);
        if (!next) return;
        event.preventDefault();
        event.stopPropagation();
        editBlocks(next.blocks);
        select(next.selected, next.blocks);
        focusBlock(event.currentTarget, next.selected);
      }}
      onDblClick={(event) => {
        if (!canPose.value) return;
        const time = timeAt(event.clientX, event.currentTarget.getBoundingClientRect(), shownSpan.value);
        const next = added(shown.value, time, newViseme(shown.value, time), duration);
        editBlocks(next);
        select(blockAt(next, time), next);
      }}
    >
      {inWindow.value.map(({ block, index }, place) => (
        <BlockButton key={index} block={block} index={index} isFirst={place === 0} />
      ))}
    </fieldset>
  );
}

type BlockButtonProps = { readonly block: Block; readonly index: number; readonly isFirst: boolean };

/** The one in hand is in the tab order, or the first while none is. */
function BlockButton({ block, index, isFirst }: BlockButtonProps): JSX.Element {
  const span = shownSpan.value;
  const left = shareOf(block.t, span);
  const isSelected = selectedIndex.value === index;
  return (
    <button
      type="button"
      class={`viseme ${kindOf(block.viseme)}`}
      style={{ left: `${100 * left}%`, width: `${100 * (shareOf(endOf(block), span) - left)}%` }}
      aria-pressed={isSelected}
      aria-label={`${block.viseme}, ${SOUNDS[block.viseme]}, ${block.t.toFixed(2)} to ${endOf(block).toFixed(2)} seconds`}
      title={`${SOUNDS[block.viseme]} · ${Math.round(1000 * block.d)} ms`}
      tabIndex={isSelected || isFirst ? 0 : -1}
      data-index={index}
      onFocus={() => {
        selectedIndex.value = index;
      }}
    >
      {block.viseme === 'sil' ? '' : block.viseme}
    </button>
  );
}

const meets = (block: Block, { start, end }: Span): boolean => endOf(block) >= start && block.t <= end;

function kindOf(viseme: Viseme): string {
  if (viseme === 'sil') return 'rest';
  if (viseme === 'PP' || viseme === 'FF') return 'closure';
  return VOWELS.includes(viseme) ? 'vowel' : 'consonant';
}

/** In a vowel a closure is missed most; elsewhere a vowel. */
function newViseme(shown: Blocks, time: number): Viseme {
  const under = shown[blockAt(shown, time)];
  return under && VOWELS.includes(under.viseme) ? 'PP' : 'aa';
}

function select(index: number, among: Blocks): void {
  selectedIndex.value = among[index] ? index : null;
  if (among[index]) reveal(among[index].t + among[index].d / 2);
}

/** After the lane has been drawn with the new blocks. */
function focusBlock(lane: HTMLElement, index: number): void {
  requestAnimationFrame(() => lane.querySelector<HTMLElement>(`[data-index="${index}"]`)?.focus());
}

const secondsPerPixel = ({ width }: DOMRect): number => (shownSpan.value.end - shownSpan.value.start) / width;
