/** Keeps the stage's DOM equal to the state: picture, frame, layers, view and overlay, once an animation frame at most. */
import { effect, untracked } from '@preact/signals';
import type { Rig } from '../rig/rig';
import { edit, ghostShown, landmarksShown, meshShown, playing, scene, session, tool } from '../store/state';
import { createOverlay, type Overlay } from './overlay';
import { OPENING_NAMES, type Picture, pictureOf, showGradient, showLayers } from './picture';
import { rig, standing, standingPoints, tendRigs } from './posing';
import { viewBoxOf } from './view';
import { hoveredTarget, stageSize, view } from './viewState';

export type StageElements = {
  /** Holds the picture; its `viewBox` is the view. */
  readonly picture: SVGSVGElement;
  /** Empty group of `picture` that the scene is put into. */
  readonly slot: SVGGElement;
  /** Holds handles and mesh, in screen pixels. */
  readonly overlay: SVGSVGElement;
};

/** Renders until the returned function is called. */
export function startRendering({ picture: host, slot, overlay: overlayHost }: StageElements): () => void {
  const overlay = createOverlay();
  overlayHost.replaceChildren(overlay.root);
  const disposals = [
    effect(() => host.setAttribute('viewBox', viewBoxOf(view.value, stageSize.value))),
    renderPicture(slot),
    tendRigs(),
    eachFrame(() => drawOverlay(overlay)),
    effect(() => overlay.highlight(hoveredTarget.value?.kind === 'landmark' ? hoveredTarget.value.index : null)),
  ];
  return () => {
    for (const dispose of disposals) dispose();
    slot.replaceChildren();
  };
}

/** A new scene or rig replaces the picture; a new pose changes the paths it moves. */
function renderPicture(slot: SVGGElement): () => void {
  let picture: Picture | null = null;
  let posed: Rig | null = null;
  const disposePicture = effect(() => {
    picture = scene.value ? pictureOf(scene.value) : null;
    posed = null;
    slot.replaceChildren(...(picture ? [picture.root] : []));
    const { layers } = untracked(() => edit.value);
    if (picture) showLayers(picture, layers);
  });
  const disposeLayers = effect(() => {
    const { layers } = edit.value;
    if (picture) showLayers(picture, layers);
  });
  const disposeFrames = eachFrame(() => {
    scene.value; // a new picture needs a frame even if the rig and the pose stay
    const current = rig.value;
    const now = standing.value;
    if (!picture || !current || !now) return;
    const isFirst = posed !== current;
    posed = current;
    showFrame(picture, current, now.vertices, isFirst);
  });
  return () => {
    disposeFrames();
    disposeLayers();
    disposePicture();
  };
}

function showFrame(picture: Picture, current: Rig, vertices: Float64Array, isFirst: boolean): void {
  const frame = current.frame(vertices, picture.axes);
  if (isFirst) {
    picture.paths.forEach((path, index) => {
      path.setAttribute('d', frame.d(index));
      showGradient(picture, index, picture.axes, 4 * index);
    });
  }
  frame.changed.forEach((index, k) => {
    picture.paths[index].setAttribute('d', frame.d(index));
    showGradient(picture, index, frame.axes, 4 * k);
  });
  const openings = current.openings(vertices);
  OPENING_NAMES.forEach((name, index) => {
    picture.openings[name].setAttribute('d', openings[index]);
  });
}

function drawOverlay(overlay: Overlay): void {
  const landmarks = edit.value.landmarks;
  const now = standing.value;
  const current = rig.value;
  const isEditing = session.value.kind === 'editing' && !playing.value;
  const shown = {
    points: isEditing && landmarksShown.value && landmarks !== null,
    mesh: isEditing && meshShown.value && current !== null,
    ghost: isEditing && ghostShown.value && tool.value !== 'rest' && landmarks !== null,
  };
  overlay.draw({
    view: view.value,
    stage: stageSize.value,
    points: standingPoints.value,
    rest: landmarks?.points ?? [],
    irises: tool.value === 'rest' ? (landmarks?.irises?.map(({ centre }) => centre) ?? []) : [],
    vertices: now?.vertices ?? [],
    triangles: current?.triangles ?? [],
    limiting: isEditing ? (now?.limit.triangles ?? []) : [],
    shown,
  });
}

/** Runs `draw` before the next paint whenever what it read has changed. */
function eachFrame(draw: () => void): () => void {
  let request = 0;
  let dispose = () => {};
  const run = () => {
    request = 0;
    dispose();
    let isFirstRun = true;
    dispose = effect(() => {
      if (isFirstRun) draw();
      else if (request === 0) request = requestAnimationFrame(run);
      isFirstRun = false;
    });
  };
  run();
  return () => {
    cancelAnimationFrame(request);
    dispose();
  };
}
