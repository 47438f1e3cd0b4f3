/** The waveform of the shown part. A click moves the playhead, a drag selects a part to be listened to again. */

import { effect, useSignal, useSignalEffect } from '@preact/signals';
import type { JSX, TargetedPointerEvent } from 'preact';
import { useEffect, useRef } from 'preact/hooks';
import type { Span } from '../api/schema';
import { theme, timeSeconds } from '../store/state';
import { seek } from '../timeline/playback';
import type { Sound } from './decoding';
import { peaksOf } from './envelope';
import { sound } from './sound';
import { selectedSpan } from './state';
import { shareOf, shownSpan, timeAt } from './stripView';

const QUIETEST = 0.02; // of full scale; a clip below it is shown as the silence that it is
const LEAST_SPAN_SECONDS = 0.2; // shorter drags are clicks

export function Waveform(): JSX.Element {
  const canvas = useRef<HTMLCanvasElement>(null);
  const width = useSignal(0);
  const pressed = useRef<number | null>(null);
  useEffect(
    () =>
      observeWidth(canvas.current, (next) => {
        width.value = next;
      }),
    [],
  );
  const scheme = useSignal(0);
  useEffect(
    () =>
      observeScheme(() => {
        scheme.value += 1;
      }),
    [],
  );
  useSignalEffect(() => {
    const [span, heard, wide] = [shownSpan.value, sound.value, width.value];
    theme.value;
    scheme.value;
    // In the next frame: the page has the colours of the theme by then.
    const request = requestAnimationFrame(() => {
      if (canvas.current && wide > 0) draw(canvas.current, wide, span, heard);
    });
    return () => cancelAnimationFrame(request);
  });
  const timeOf = (event: TargetedPointerEvent<HTMLElement>) =>
    timeAt(event.clientX, event.currentTarget.getBoundingClientRect(), shownSpan.value);
  return (
    <div
      class="waveform"
      onPointerDown={(event) => {
        event.currentTarget.setPointerCapture(event.pointerId);
        pressed.current = timeOf(event);
        selectedSpan.value = null;
      }}
      onPointerMove={(event) => {
        if (pressed.current !== null) selectedSpan.value = spanBetween(pressed.current, timeOf(event));
      }}
      onPointerUp={(event) => {
        if (pressed.current !== null && !selectedSpan.value) seek(timeOf(event));
        pressed.current = null;
      }}
      onPointerCancel={() => {
        pressed.current = null;
        selectedSpan.value = null;
      }}
    >
      <canvas ref={canvas} role="img" aria-label="Waveform" />
      <Selection />
    </div>
  );
}

function Selection(): JSX.Element | null {
  const span = selectedSpan.value;
  if (!span) return null;
  const left = shareOf(span.start, shownSpan.value);
  const right = shareOf(span.end, shownSpan.value);
  return <i class="selected-span" style={{ left: `${100 * left}%`, width: `${100 * (right - left)}%` }} />;
}

/** Moves itself, in the same frame as the picture: nothing is drawn anew while a track plays. */
export function StripPlayhead(): JSX.Element {
  const mark = useRef<HTMLElement>(null);
  useEffect(
    () =>
      effect(() => {
        const share = shareOf(timeSeconds.value, shownSpan.value);
        if (!mark.current) return;
        mark.current.style.left = `${100 * share}%`;
        mark.current.hidden = share < 0 || share > 1;
      }),
    [],
  );
  return <i class="playhead" ref={mark} />;
}

function spanBetween(a: number, b: number): Span | null {
  const span = { start: Math.max(0, Math.min(a, b)), end: Math.max(a, b) };
  return span.end - span.start < LEAST_SPAN_SECONDS ? null : span;
}

/** One bar a device pixel, mirrored about the middle; the loudest of the clip fills the height. */
function draw(canvas: HTMLCanvasElement, width: number, { start, end }: Span, heard: Sound | null): void {
  const context = canvas.getContext('2d');
  if (!context) return;
  canvas.width = Math.round(width * window.devicePixelRatio);
  canvas.height = Math.round(canvas.clientHeight * window.devicePixelRatio);
  if (!heard) return;
  context.fillStyle = getComputedStyle(canvas).color;
  const middle = canvas.height / 2;
  const scale = Math.max(heard.loudest, QUIETEST);
  peaksOf(heard.mono, start, end, canvas.width).forEach((peak, x) => {
    const half = Math.max(0.5, 0.95 * (peak / scale) * middle);
    context.fillRect(x, middle - half, 1, 2 * half);
  });
}

/** The system may turn from light to dark by itself, at dusk. */
function observeScheme(onChange: () => void): () => void {
  const query = matchMedia('(prefers-color-scheme: dark)');
  query.addEventListener('change', onChange);
  return () => query.removeEventListener('change', onChange);
}

function observeWidth(element: HTMLElement | null, onWidth: (width: number) => void): (() => void) | undefined {
  if (!element) return undefined;
  const observer = new ResizeObserver(([{ contentRect }]) => onWidth(contentRect.width));
  observer.observe(element);
  return () => observer.disconnect();
}
