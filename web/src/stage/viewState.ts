/** What the stage shows of the portrait; not part of the document. */
import { computed, signal } from '@preact/signals';
import { portrait } from '../store/state';
import type { Target } from './tools/gesture';
import { fitView, type Size, type View, ZOOM_STEP, zoomAt } from './view';

export const stageSize = signal<Size>({ width: 0, height: 0 });
const chosenView = signal<View | null>(null);
const WHOLE: View = { centre: [0, 0], scale: 1 };

/** Fitted until somebody zooms or pans. */
export const view = computed<View>(() => {
  if (chosenView.value) return chosenView.value;
  const size = portrait.value;
  return size && stageSize.value.width > 0 ? fitView(size, stageSize.value) : WHOLE;
});

export const hoveredTarget = signal<Target | null>(null);

export function lookAt(next: View): void {
  chosenView.value = next;
}

export function fitToStage(): void {
  chosenView.value = null;
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
