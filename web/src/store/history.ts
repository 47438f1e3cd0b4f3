/** Undo and redo as a list of immutable documents: past, present, future. */

export type History<T> = { readonly past: readonly T[]; readonly present: T; readonly future: readonly T[] };

export function historyOf<T>(present: T): History<T> {
  return { past: [], present, future: [] };
}

/** Makes `next` the present; what was undone before is forgotten. The same document again is no step. */
export function commit<T>(history: History<T>, next: T): History<T> {
  if (next === history.present) return history;
  return { past: [...history.past, history.present], present: next, future: [] };
}

/** The same without what was undone. */
export function forgetUndone<T>(history: History<T>): History<T> {
  return { ...history, future: [] };
}

export function undo<T>(history: History<T>): History<T> {
  const previous = history.past.at(-1);
  if (previous === undefined) return history;
  return { past: history.past.slice(0, -1), present: previous, future: [history.present, ...history.future] };
}

export function redo<T>(history: History<T>): History<T> {
  const [next, ...future] = history.future;
  if (next === undefined) return history;
  return { past: [...history.past, history.present], present: next, future };
}
