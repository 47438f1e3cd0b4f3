/** Turns the stage's pointer, wheel and pinch events into gesture steps and view changes. */
import type { Xy } from '../face/vector';
import { discard, settle, sketch } from '../store/editing';
import { history, portrait } from '../store/state';
import { heldWith } from './held';
import { type Gesture, IDLE, type Outcome, type PointerStep, type Press, step, type Tool } from './tools/gesture';
import { panBy, toPortrait, zoomAt } from './view';
import { hoveredTarget, lookAt, stageSize, view } from './viewState';

const WHEEL_PIXELS_PER_DOUBLING = 400;

export type PointerOptions = {
  /** The tool in hand now, asked for at every press. */
  readonly tool: () => Tool;
  readonly panning: () => boolean;
  readonly panTool: Tool;
};

/** Listens on `stage` until the returned function is called. */
export function listenToPointers(stage: HTMLElement, options: PointerOptions): () => void {
  let gesture: Gesture = IDLE;
  let active: Tool = options.panTool;
  const fingers = new Map<number, Xy>();

  function advance(event: PointerStep): void {
    const [next, outcome] = step(gesture, event, active);
    gesture = next;
    carryOut(outcome);
  }

  function down(event: PointerEvent): void {
    if (event.target instanceof Element && event.target.closest('[data-own-pointer]')) return;
    const press = pressOf(event, stage);
    fingers.set(event.pointerId, press.screen);
    if (fingers.size > 1) return advance({ kind: 'cancel' });
    if (event.button > 1) return;
    stage.setPointerCapture(event.pointerId);
    active = options.panning() || event.button === 1 ? options.panTool : options.tool();
    advance({ kind: 'down', press, start: { edit: history.value.present, view: view.value } });
  }

  function move(event: PointerEvent): void {
    const press = pressOf(event, stage);
    if (fingers.size > 1 && fingers.has(event.pointerId)) return pinch(event.pointerId, press.screen);
    fingers.set(event.pointerId, press.screen);
    if (gesture.kind === 'idle') hoveredTarget.value = options.panning() ? null : options.tool().aim(press);
    else advance({ kind: 'move', press });
  }

  function up(event: PointerEvent): void {
    fingers.delete(event.pointerId);
    advance({ kind: 'up', press: pressOf(event, stage) });
  }

  function cancel(event: PointerEvent): void {
    fingers.delete(event.pointerId);
    advance({ kind: 'cancel' });
  }

  function pinch(pointerId: number, to: Xy): void {
    const from = fingers.get(pointerId) ?? to;
    const other = [...fingers].find(([id]) => id !== pointerId)?.[1] ?? to;
    const size = portrait.value;
    fingers.set(pointerId, to);
    if (!size) return;
    const factor = Math.hypot(to[0] - other[0], to[1] - other[1]) / Math.max(1, Math.hypot(from[0] - other[0], from[1] - other[1]));
    const moved = panBy(view.value, [(to[0] - from[0]) / 2, (to[1] - from[1]) / 2], size);
    lookAt(zoomAt(moved, [(to[0] + other[0]) / 2, (to[1] + other[1]) / 2], factor, size, stageSize.value));
  }

  function wheel(event: WheelEvent): void {
    event.preventDefault();
    const size = portrait.value;
    if (!size) return;
    const speed = event.ctrlKey ? 4 : 1; // a pinch on a trackpad arrives as small wheel steps with Ctrl
    const factor = 2 ** ((-event.deltaY * speed) / WHEEL_PIXELS_PER_DOUBLING);
    lookAt(zoomAt(view.value, pressOf(event, stage).screen, factor, size, stageSize.value));
  }

  function doubleClick(event: MouseEvent): void {
    const press = pressOf(event, stage);
    const target = options.tool().aim(press);
    if (!target) return;
    carryOut(options.tool().reset(target, { edit: history.value.present, view: view.value }));
    settle();
  }

  const cancelOnEscape = (event: KeyboardEvent) => {
    if (event.key === 'Escape' && gesture.kind !== 'idle') advance({ kind: 'cancel' });
  };
  const leave = () => {
    hoveredTarget.value = null;
  };
  const listeners: readonly [EventTarget, string, EventListener][] = [
    [stage, 'pointerdown', down as EventListener],
    [stage, 'pointermove', move as EventListener],
    [stage, 'pointerup', up as EventListener],
    [stage, 'pointercancel', cancel as EventListener],
    [stage, 'pointerleave', leave],
    [stage, 'wheel', wheel as EventListener],
    [stage, 'dblclick', doubleClick as EventListener],
    [window, 'keydown', cancelOnEscape as EventListener],
  ];
  for (const [target, name, listener] of listeners) target.addEventListener(name, listener, { passive: false });
  return () => {
    for (const [target, name, listener] of listeners) target.removeEventListener(name, listener);
  };
}

function carryOut(outcome: Outcome): void {
  switch (outcome.kind) {
    case 'nothing':
      return;
    case 'sketch':
      return sketch(outcome.edit);
    case 'settle':
      return settle();
    case 'discard':
      return discard();
    case 'look':
      return lookAt(outcome.view);
    default: {
      const unknown: never = outcome;
      throw new RangeError(`Unknown outcome ${unknown}`);
    }
  }
}

function pressOf(event: MouseEvent, stage: HTMLElement): Press {
  const box = stage.getBoundingClientRect();
  const screen: Xy = [event.clientX - box.left, event.clientY - box.top];
  return { screen, portrait: toPortrait(view.value, stageSize.value, screen), ...heldWith(event) };
}
