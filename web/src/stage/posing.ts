/** The rig of the present scene and rest landmarks, and where it stands now: computed, never stored. */
import { computed, effect, signal } from '@preact/signals';
import type { Xy } from '../face/vector';
import { buildRig, type Rig } from '../rig/rig';
import { REST_POSE } from '../store/edit';
import { FileError, report } from '../store/notices';
import { edit, history, scene, timeSeconds, tool, track } from '../store/state';
import { undoStep } from '../store/steps';
import { posedBy } from '../timeline/track';

/** Set once the WASM module is there. */
export const rigModuleReady = signal(false);

/** Rebuilt when a finer scene comes and when a correction of the rest landmarks is let go. */
const restLandmarks = computed(() => history.value.present.landmarks);

type Rigged =
  | { readonly kind: 'none' }
  | { readonly kind: 'rigged'; readonly rig: Rig }
  | { readonly kind: 'refused'; readonly reason: Error };

const rigged = computed<Rigged>(() => {
  if (!rigModuleReady.value || !scene.value || !restLandmarks.value) return { kind: 'none' };
  try {
    return { kind: 'rigged', rig: buildRig(scene.value, restLandmarks.value) };
  } catch (reason) {
    if (!(reason instanceof Error)) throw reason;
    return { kind: 'refused', reason };
  }
});

export const rig = computed<Rig | null>(() => (rigged.value.kind === 'rigged' ? rigged.value.rig : null));

/** Says why landmarks span no face, and gives the memory of replaced rigs back, until the returned function is called. */
export function tendRigs(): () => void {
  let shown: Rig | null = null;
  return effect(() => {
    const now = rigged.value;
    if (now.kind === 'refused') report(new FileError(now.reason.message), { label: 'Undo', run: undoStep });
    const next = now.kind === 'rigged' ? now.rig : null;
    if (shown && shown !== next) retire(shown);
    shown = next;
  });
}

/** Frames that are being drawn may still read it. */
function retire(old: Rig): void {
  requestAnimationFrame(() => requestAnimationFrame(() => old.dispose()));
}

/** While the rest landmarks are corrected, the portrait stands as it was drawn. */
export const standingPose = computed(() => (tool.value === 'rest' ? REST_POSE : posedBy(edit.value.pose, track.value, timeSeconds.value)));

/** Vertices of the mesh in that pose, and what stops it. */
export const standing = computed(() => rig.value?.vertices(standingPose.value) ?? null);

/** The 68 landmarks as they stand: corrected ones in the rest tool, posed ones otherwise. */
export const standingPoints = computed<readonly Xy[]>(() => {
  const rest = edit.value.landmarks?.points ?? [];
  const vertices = standing.value?.vertices;
  if (!vertices || tool.value === 'rest') return rest;
  return rest.map((_, index): Xy => [vertices[2 * index], vertices[2 * index + 1]]);
});
