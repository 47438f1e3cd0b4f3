/** Landmark handles by keyboard: Tab goes from group to group, Page Up and Down within one, arrows nudge. */
import { GROUPS, groupOf } from '../face/ibug';
import type { Xy } from '../face/vector';
import { withoutOffsets } from '../store/edit';
import { apply, settle, sketch } from '../store/editing';
import { edit, tool } from '../store/state';
import { heldWith } from './held';
import { describeHandle } from './overlay';
import { standingPoints } from './posing';
import { REACH } from './reach';
import { dragLandmark } from './tools/poseTool';
import { correctLandmark } from './tools/restTool';

const NUDGES: Readonly<Record<string, Xy>> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
const NUDGE = 0.5; // portrait pixels
const LONG_NUDGE = 5;

/** Listens on the overlay until the returned function is called. */
export function listenToHandleKeys(overlay: SVGSVGElement): () => void {
  for (const group of GROUPS) handleAt(overlay, group.first)?.setAttribute('tabindex', '0');
  const listeners: readonly [string, EventListener][] = [
    ['focusin', (event) => announceHandle(event.target)],
    ['keydown', (event) => press(overlay, event as KeyboardEvent)],
    ['keyup', (event) => release(event as KeyboardEvent)],
  ];
  for (const [name, listener] of listeners) overlay.addEventListener(name, listener);
  return () => {
    for (const [name, listener] of listeners) overlay.removeEventListener(name, listener);
  };
}

function press(overlay: SVGSVGElement, event: KeyboardEvent): void {
  const index = landmarkOf(event.target);
  if (index === null) return;
  const direction = NUDGES[event.key];
  if (direction) nudge(index, direction, event);
  else if (event.key === 'PageDown') moveFocus(overlay, index, 1);
  else if (event.key === 'PageUp') moveFocus(overlay, index, -1);
  else if (event.key === 'Delete' || event.key === 'Backspace') apply((present) => withoutOffsets(present, [index]));
  else return;
  event.preventDefault();
  event.stopPropagation();
}

/** A held arrow key is one step. */
function release(event: KeyboardEvent): void {
  if (!NUDGES[event.key] || landmarkOf(event.target) === null) return;
  settle();
  announceHandle(event.target);
}

function nudge(index: number, direction: Xy, event: KeyboardEvent): void {
  const length = event.shiftKey ? LONG_NUDGE : NUDGE;
  const moved: Xy = [direction[0] * length, direction[1] * length];
  const rest = edit.value.landmarks?.points;
  if (!rest) return;
  if (tool.value === 'rest') sketch(correctLandmark(edit.value, index, moved, heldWith(event), REACH));
  else sketch(dragLandmark(edit.value, index, rest, moved, heldWith(event), REACH));
}

function moveFocus(overlay: SVGSVGElement, index: number, by: number): void {
  const { first, count } = groupOf(index);
  const next = first + ((index - first + by + count) % count);
  handleAt(overlay, index)?.setAttribute('tabindex', '-1');
  const handle = handleAt(overlay, next);
  handle?.setAttribute('tabindex', '0');
  handle?.focus();
}

function announceHandle(target: EventTarget | null): void {
  const index = landmarkOf(target);
  const rest = edit.value.landmarks?.points;
  if (index === null || !rest || !(target instanceof Element)) return;
  describeHandle(target, index, standingPoints.value[index], rest[index]);
}

function landmarkOf(target: EventTarget | null): number | null {
  const value = target instanceof Element ? target.getAttribute('data-landmark') : null;
  return value === null ? null : Number(value);
}

const handleAt = (overlay: SVGSVGElement, index: number) => overlay.querySelector<SVGCircleElement>(`[data-landmark="${index}"]`);
