/** Actions on the document: drafts while something is dragged, steps when it is let go. */
import type { Edit } from './edit';
import { commit } from './history';
import { draft, history } from './state';

/** Shows an unfinished edit; nothing is kept until `settle`. */
export function sketch(next: Edit): void {
  draft.value = next;
}

/** Makes the sketched edit one step. */
export function settle(): void {
  if (draft.value) history.value = commit(history.value, draft.value);
  draft.value = null;
}

/** Forgets the sketched edit. */
export function discard(): void {
  draft.value = null;
}

/** One finished edit: `change` gets the present document and returns the next one. */
export function apply(change: (edit: Edit) => Edit): void {
  draft.value = null;
  history.value = commit(history.value, change(history.value.present));
}

/** Changes the present document without a step: what was asked for earlier has come. */
export function amend(change: (edit: Edit) => Edit): void {
  history.value = { ...history.value, present: change(history.value.present) };
}
