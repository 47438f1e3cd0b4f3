/** Portraits give way to others and come back, with all the work on them. Their order stays; edits of one lose none of the others. */
import { forgetUndone } from './history';
import { clearStage, putOnStage, workOnStage } from './stage';
import { type PortraitWork, type Replaced, replaced } from './state';

const MOST = 12; // portraits kept on either side: with their pictures, what browsers let a page store

/**
 * Keeps the portrait on the stage before another takes its place; null: there is none. What was undone on it is forgotten, as by
 * any other step.
 */
export function putAside(): PortraitWork | null {
  const open = workOnStage();
  if (!open) return null;
  const work = { ...open, history: forgetUndone(open.history) };
  const { before, after } = replaced.value;
  replaced.value = { before: [...before, work].slice(-MOST), after };
  return work;
}

/** The portrait that gave way to the one on the stage takes its place again; null: there is none. */
export function bringBack(): PortraitWork | null {
  const { before, after } = replaced.value;
  return exchange(before.at(-1), (here) => ({ before: before.slice(0, -1), after: [...here, ...after].slice(0, MOST) }));
}

/** The portrait that `bringBack` took off the stage comes back; null: there is none. */
export function bringForward(): PortraitWork | null {
  const { before, after } = replaced.value;
  return exchange(after[0], (here) => ({ before: [...before, ...here].slice(-MOST), after: after.slice(1) }));
}

/** Fills an empty stage with the portrait opened before the one that was there, or after it; null: there is none. */
export function bringNearest(): PortraitWork | null {
  const { before, after } = replaced.value;
  const nearest = before.at(-1) ?? after[0];
  if (!nearest) return null;
  replaced.value = before.length > 0 ? { before: before.slice(0, -1), after } : { before, after: after.slice(1) };
  putOnStage(nearest);
  return nearest;
}

/** `rest`: what is kept, given the portrait that leaves the stage, if there is one. */
function exchange(next: PortraitWork | undefined, rest: (here: readonly PortraitWork[]) => Replaced): PortraitWork | null {
  if (!next) return null;
  const here = workOnStage();
  replaced.value = rest(here ? [here] : []);
  clearStage();
  putOnStage(next);
  return next;
}
