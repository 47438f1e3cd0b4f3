/** One pointer gesture as a state machine: idle, pointing (pressed, not yet moved), dragging. Every tool runs in it. */

import type { Region } from '../../face/regions';
import type { Xy } from '../../face/vector';
import type { Edit } from '../../store/edit';
import type { Held } from '../held';
import type { View } from '../view';

/** A pointer on the stage: where it is, and what is held with it. */
export type Press = Held & { readonly screen: Xy; readonly portrait: Xy };

export type Target =
  | { readonly kind: 'landmark'; readonly index: number }
  | { readonly kind: 'iris'; readonly index: 0 | 1 }
  | { readonly kind: 'region'; readonly region: Region }
  | { readonly kind: 'canvas' };

export type Gesture =
  | { readonly kind: 'idle' }
  | { readonly kind: 'pointing'; readonly target: Target; readonly from: Press; readonly start: Start }
  | { readonly kind: 'dragging'; readonly target: Target; readonly from: Press; readonly start: Start };

/** The document and the view as they were when the pointer went down. */
export type Start = { readonly edit: Edit; readonly view: View };

export type Outcome =
  | { readonly kind: 'nothing' }
  | { readonly kind: 'sketch'; readonly edit: Edit }
  | { readonly kind: 'settle' }
  | { readonly kind: 'discard' }
  | { readonly kind: 'look'; readonly view: View };

export type Tool = {
  /** What a press here would grab; null: nothing. */
  readonly aim: (press: Press) => Target | null;
  readonly drag: (target: Target, start: Start, from: Press, to: Press) => Outcome;
  /** A press and release in one place. */
  readonly click: (target: Target, start: Start, at: Press) => Outcome;
  /** Back to what it was before anybody touched it. */
  readonly reset: (target: Target, start: Start) => Outcome;
  readonly hint: (target: Target | null) => string;
};

export type PointerStep =
  | { readonly kind: 'down'; readonly press: Press; readonly start: Start }
  | { readonly kind: 'move'; readonly press: Press }
  | { readonly kind: 'up'; readonly press: Press }
  | { readonly kind: 'cancel' };

export const IDLE: Gesture = { kind: 'idle' };
export const NOTHING: Outcome = { kind: 'nothing' };
const SLOP = 3; // screen pixels a hand trembles while it clicks

export function step(gesture: Gesture, event: PointerStep, tool: Tool): readonly [Gesture, Outcome] {
  switch (gesture.kind) {
    case 'idle':
      return event.kind === 'down' ? pointed(event.press, event.start, tool) : [gesture, NOTHING];
    case 'pointing':
      return fromPointing(gesture, event, tool);
    case 'dragging':
      return fromDragging(gesture, event, tool);
    default: {
      const unknown: never = gesture;
      throw new RangeError(`Unknown gesture ${unknown}`);
    }
  }
}

function pointed(from: Press, start: Start, tool: Tool): readonly [Gesture, Outcome] {
  const target = tool.aim(from);
  return target ? [{ kind: 'pointing', target, from, start }, NOTHING] : [IDLE, NOTHING];
}

function fromPointing(gesture: Gesture & { kind: 'pointing' }, event: PointerStep, tool: Tool): readonly [Gesture, Outcome] {
  const { target, from, start } = gesture;
  if (event.kind === 'cancel') return [IDLE, NOTHING];
  if (event.kind === 'up') return [IDLE, tool.click(target, start, event.press)];
  if (event.kind === 'down') return [gesture, NOTHING];
  const travelled = Math.hypot(event.press.screen[0] - from.screen[0], event.press.screen[1] - from.screen[1]);
  return travelled < SLOP ? [gesture, NOTHING] : fromDragging({ ...gesture, kind: 'dragging' }, event, tool);
}

function fromDragging(gesture: Gesture & { kind: 'dragging' }, event: PointerStep, tool: Tool): readonly [Gesture, Outcome] {
  switch (event.kind) {
    case 'move':
      return [gesture, tool.drag(gesture.target, gesture.start, gesture.from, event.press)];
    case 'up':
      return [IDLE, { kind: 'settle' }];
    case 'cancel':
      return [IDLE, { kind: 'discard' }];
    case 'down':
      return [gesture, NOTHING];
    default: {
      const unknown: never = event;
      throw new RangeError(`Unknown pointer event ${unknown}`);
    }
  }
}
