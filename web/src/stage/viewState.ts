/** What the stage shows of the portrait; not part of the document. */
import { computed, signal } from '@preact/signals';
import { portrait } from '../store/state';
import type { Target } from './tools/gesture';
import { fitView, type Size, type View, ZOOM_STEP, zoomAt } from './view';

export const stageSize = signal<Size>({ width: 0, height: 0 });
/** What was zoomed or panned to, on the picture that it was chosen for. */
const chosen = signal<{ readonly picture: string; readonly view: View } | null>(null);
const picture = computed(() => `${portrait.value?.name} ${portrait.value?.width} ${portrait.value?.height}`);
const WHOLE: View = { centre: [0, 0], scale: 1 };

/** Fitted until somebody zooms or pans; another picture is fitted anew. */
export const view = computed<View>(() => {
  if (chosen.value?.picture === picture.value) return chosen.value.view;
  const size = portrait.value;
  return size && stageSize.value.width > 0 ? fitView(size, stageSize.value) : WHOLE;
});

export const hoveredTarget = signal<Target | null>(null);

export function lookAt(next: View): void {
  chosen.value = { picture: picture.peek(), view: next };
}

export function fitToStage(): void {
  chosen.value = null;
}

/** One step in (1) or out (−1), about the middle of the stage. */
export function zoomStep(direction: 1 | -1): void {
  const size = portrait.value;
  const { width, height } = stageSize.value;
  if (size) lookAt(zoomAt(view.value, [width / 2, height / 2], ZOOM_STEP ** direction, size, stageSize.value));
}

/** One screen pixel a portrait pixel. */
export function actualSize(): void {
  lookAt({ ...view.value, scale: 1 });
}
