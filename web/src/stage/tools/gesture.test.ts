import { describe, expect, it } from 'vitest';
import type { Xy } from '../../face/vector';
import { editOf, withChannel } from '../../store/edit';
import { type Gesture, IDLE, type Outcome, type PointerStep, type Press, type Start, step, type Tool } from './gesture';

const START: Start = { edit: editOf('Portrait', null), view: { centre: [0, 0], scale: 1 } };
const SKETCHED = withChannel(START.edit, 'jaw', 1);
const press = (x: number, y: number): Press => ({ screen: [x, y], portrait: [x, y] as Xy, pressure: null, shift: false, alt: false });

const TOOL: Tool = {
  aim: ({ screen }) => (screen[0] < 0 ? null : { kind: 'canvas' }),
  drag: () => ({ kind: 'sketch', edit: SKETCHED }),
  click: (_target, { view }) => ({ kind: 'look', view }),
  reset: () => ({ kind: 'nothing' }),
  hint: () => '',
};

const down: PointerStep = { kind: 'down', press: press(10, 10), start: START };
const move = (x: number, y: number): PointerStep => ({ kind: 'move', press: press(x, y) });
const up: PointerStep = { kind: 'up', press: press(40, 10) };

/** The last state and everything that came out on the way. */
function run(...events: readonly PointerStep[]): { gesture: Gesture; outcomes: string[] } {
  const outcomes: Outcome[] = [];
  const gesture = events.reduce((state, event) => {
    const [next, outcome] = step(state, event, TOOL);
    outcomes.push(outcome);
    return next;
  }, IDLE);
  return { gesture, outcomes: outcomes.map(({ kind }) => kind) };
}

describe('a pointer gesture', () => {
  it('sketches while dragging and settles once when let go', () => {
    expect(run(down, move(20, 10), move(40, 10), up)).toEqual({ gesture: IDLE, outcomes: ['nothing', 'sketch', 'sketch', 'settle'] });
  });

  it('is a click when the hand only trembles', () => {
    expect(run(down, move(11, 11), { kind: 'up', press: press(11, 11) }).outcomes).toEqual(['nothing', 'nothing', 'look']);
  });

  it('is discarded by a cancel in the middle of a drag', () => {
    expect(run(down, move(40, 10), { kind: 'cancel' }, move(60, 10), up)).toEqual({
      gesture: IDLE,
      outcomes: ['nothing', 'sketch', 'discard', 'nothing', 'nothing'],
    });
  });

  it('does not start where the tool finds nothing', () => {
    expect(run({ ...down, press: press(-5, 0) }, move(40, 10), up).outcomes).toEqual(['nothing', 'nothing', 'nothing']);
  });
});
