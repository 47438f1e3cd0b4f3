/** Five pins and a ghost face, for portraits whose face was not found or not well fitted. */
import type { JSX } from 'preact';
import type { Landmarks } from '../api/schema';
import { GROUPS, indicesOf } from '../face/ibug';
import type { Xy } from '../face/vector';
import { fitPins } from '../rig/rig';
import { Button } from '../shell/Button';
import { movePin, stopPinning, useFit } from '../store/opening';
import { type Pins as PinPoints, scene, session } from '../store/state';
import { rigModuleReady } from './posing';
import { toPortrait, toScreen } from './view';
import { stageSize, view } from './viewState';

const NAMES = ['Left eye', 'Right eye', 'Nose tip', 'Left mouth corner', 'Right mouth corner'] as const;
const NUDGES: Readonly<Record<string, Xy>> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };

export function Pins(): JSX.Element | null {
  const now = session.value;
  if (now.kind !== 'pinning') return null;
  const fit = fitOf(now.pins);
  return (
    <>
      <svg class="pins-ghost" aria-hidden="true">
        {fit && <path class="pins-face" d={facePath(fit)} />}
      </svg>
      {now.pins.map((pin, index) => (
        <Pin key={NAMES[index]} index={index} pin={pin} />
      ))}
    </>
  );
}

const fitOf = (pins: PinPoints): Landmarks | null => (rigModuleReady.value ? fitPins(pins) : null);

function Pin({ index, pin }: { readonly index: number; readonly pin: Xy }): JSX.Element {
  const [left, top] = toScreen(view.value, stageSize.value, pin);
  const drag = (event: PointerEvent & { currentTarget: HTMLElement }) => {
    if (!event.currentTarget.hasPointerCapture(event.pointerId)) return;
    const box = event.currentTarget.closest('.stage')?.getBoundingClientRect();
    if (!box) return;
    const [x, y] = toPortrait(view.value, stageSize.value, [event.clientX - box.left, event.clientY - box.top]);
    movePin(index, x, y);
  };
  const nudge = (event: KeyboardEvent) => {
    const direction = NUDGES[event.key];
    if (!direction) return;
    event.preventDefault();
    const length = event.shiftKey ? 10 : 1;
    movePin(index, pin[0] + direction[0] * length, pin[1] + direction[1] * length);
  };
  return (
    <button
      type="button"
      class="pin"
      data-own-pointer
      style={{ left: `${left}px`, top: `${top}px` }}
      aria-label={`${NAMES[index]} pin, ${Math.round(pin[0])} right, ${Math.round(pin[1])} down`}
      onPointerDown={(event) => event.currentTarget.setPointerCapture(event.pointerId)}
      onPointerMove={drag}
      onKeyDown={nudge}
    >
      <span>{NAMES[index]}</span>
    </button>
  );
}

/** What to do with the pins, among the messages of the stage. */
export function PinsCard(): JSX.Element | null {
  const now = session.value;
  if (now.kind !== 'pinning') return null;
  const { pins, noFaceFound } = now;
  const fit = fitOf(pins);
  const spread = pins[1][0] > pins[0][0] && pins[4][0] > pins[3][0];
  return (
    <section class="card pins-card" aria-label="Five pins">
      <p>
        {noFaceFound && <strong>No face found. </strong>}
        Put the five pins on the eyes, the tip of the nose and the mouth corners.
      </p>
      <div class="row">
        <Button emphasis="primary" disabled={!fit || !spread} onClick={() => void useFit(fit)}>
          Use these pins
        </Button>
        {scene.value ? (
          <Button onClick={stopPinning}>Leave as it was</Button>
        ) : (
          <Button onClick={() => void useFit(null)}>Use anyway, without a face</Button>
        )}
      </div>
    </section>
  );
}

function facePath({ points }: Landmarks): string {
  const screen = points.map((point) =>
    toScreen(view.value, stageSize.value, point)
      .map((value) => value.toFixed(1))
      .join(' '),
  );
  return GROUPS.map(
    (group) =>
      `M${indicesOf(group)
        .map((index) => screen[index])
        .join('L')}${group.closed ? 'Z' : ''}`,
  ).join('');
}
