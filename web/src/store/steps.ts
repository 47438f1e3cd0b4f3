/** Undo and redo: edits first, then the portraits that gave way to others. */
import { computed } from '@preact/signals';
import { redo, undo } from './history';
import { goOnWith, stopSending } from './opening';
import { bringBack, bringForward } from './replacing';
import { draft, history, type PortraitWork, replaced, session } from './state';

/** What a step leads to: an earlier or later edit, another portrait by its name, or nothing. */
export type Step = { readonly kind: 'none' | 'edit' } | { readonly kind: 'portrait'; readonly name: string };

export const nextUndo = computed<Step>(() => {
  if (session.value.kind === 'uploading' || history.value.past.length > 0) return { kind: 'edit' };
  return toPortrait(replaced.value.before.at(-1));
});

export const nextRedo = computed<Step>(() => {
  if (session.value.kind === 'uploading') return { kind: 'none' };
  return history.value.future.length > 0 ? { kind: 'edit' } : toPortrait(replaced.value.after[0]);
});

/** A picture on its way to the server is the latest step. */
export function undoStep(): void {
  const now = session.value;
  if (now.kind === 'uploading') return stopSending(now);
  draft.value = null;
  if (history.value.past.length > 0) history.value = undo(history.value);
  else goOnWith(bringBack());
}

export function redoStep(): void {
  if (session.value.kind === 'uploading') return;
  draft.value = null;
  if (history.value.future.length > 0) history.value = redo(history.value);
  else goOnWith(bringForward());
}

const toPortrait = (work: PortraitWork | undefined): Step =>
  work ? { kind: 'portrait', name: work.history.present.name } : { kind: 'none' };
