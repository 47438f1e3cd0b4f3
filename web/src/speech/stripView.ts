/** Which part of a track the strip shows: a window that can be scrolled and zoomed, and that the playhead turns like a page. */
import { computed, effect, signal } from '@preact/signals';
import type { Span } from '../api/schema';
import { playing, timeSeconds, track } from '../store/state';

const START_SECONDS = 6; // blocks of speech are then wide enough to grab
const WHOLE_SECONDS = 9; // a track that nearly fits is shown whole, in line with the curves below
const LEAST_SECONDS = 0.5;
const ZOOM_STEP = 1.5;

const wantedFrom = signal(0);
/** Null until somebody zooms. */
const zoomedSeconds = signal<number | null>(null);

const duration = computed(() => track.value?.duration ?? 0);

/** The shown part, within the track. */
export const shownSpan = computed<Span>(() => {
  const wanted = zoomedSeconds.value ?? (duration.value > WHOLE_SECONDS ? START_SECONDS : duration.value);
  const seconds = Math.min(wanted, duration.value);
  const start = Math.min(Math.max(0, wantedFrom.value), duration.value - seconds);
  return { start, end: start + seconds };
});

/** Zooms about `around` seconds, which stays where it is on the screen. */
export function zoomStrip(direction: 1 | -1, around: number): void {
  const { start, end } = shownSpan.value;
  const seconds = Math.min(Math.max((end - start) / ZOOM_STEP ** direction, LEAST_SECONDS), Math.max(LEAST_SECONDS, duration.value));
  wantedFrom.value = around - ((around - start) / (end - start)) * seconds;
  zoomedSeconds.value = seconds;
}

export function scrollStrip(bySeconds: number): void {
  wantedFrom.value = shownSpan.value.start + bySeconds;
}

/** Shows `time`, moving as little as needed. */
export function reveal(time: number): void {
  const { start, end } = shownSpan.value;
  if (time < start) wantedFrom.value = time;
  else if (time > end) wantedFrom.value = time - (end - start);
}

/** Turns the page while playing and after seeking, until the returned function is called. */
export function followPlayhead(): () => void {
  return effect(() => {
    const now = timeSeconds.value;
    const { start, end } = shownSpan.peek();
    if (now >= start && now <= end) return;
    wantedFrom.value = playing.peek() || now < start ? now : now - (end - start) / 2;
  });
}

/** Where `time` is in the window, as a share of its width. */
export const shareOf = (time: number, { start, end }: Span): number => (time - start) / Math.max(end - start, 1e-6);

/** The time at `x` of an element's box. */
export function timeAt(clientX: number, box: DOMRect, { start, end }: Span): number {
  return start + ((clientX - box.left) / box.width) * (end - start);
}
