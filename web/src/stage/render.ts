/** Keeps the stage's DOM equal to the state: picture, frame, layers, view and overlay, once an animation frame at most. */
import { effect, untracked } from '@preact/signals';
import type { Scene } from '../api/schema';
import type { Rig } from '../rig/rig';
import { draft, edit, ghostShown, landmarksShown, meshShown, playing, scene, session, tool } from '../store/state';
import { beforePaint } from '../timeline/frame';
import { type FrameWriter, frameWriter } from './frameWriter';
import { createOverlay, type Overlay } from './overlay';
import { OPENING_NAMES, type Picture, pictureOf, showLayers, takeScenery } from './picture';
import { rig, standing, standingPoints, tendRigs } from './posing';
import { writeAttribute } from './svg';
import { viewBoxOf } from './view';
import { hoveredTarget, stageSize, view } from './viewState';

/** The `viewBox` of scenery and picture is the view. The browser keeps what it painted of the scenery as long as nothing in it changes. */
export type StageElements = {
  /** Holds what no pose moves, behind the picture. */
  readonly scenery: SVGSVGElement;
  /** Holds the picture. */
  readonly picture: SVGSVGElement;
  /** Empty group of `picture` that the scene is put into. */
  readonly slot: SVGGElement;
  /** Holds handles and mesh, in screen pixels. */
  readonly overlay: SVGSVGElement;
};

/** Renders until the returned function is called. */
export function startRendering({ scenery, picture, slot, overlay: overlayHost }: StageElements): () => void {
  const overlay = createOverlay();
  overlayHost.replaceChildren(overlay.root);
  const disposals = [
    effect(() => {
      for (const host of [scenery, picture]) host.setAttribute('viewBox', viewBoxOf(view.value, stageSize.value));
    }),
    renderPicture(scenery, slot),
    tendRigs(),
    eachFrame(() => drawOverlay(overlay)),
    effect(() => overlay.highlight(hoveredTarget.value?.kind === 'landmark' ? hoveredTarget.value.index : null)),
  ];
  return () => {
    for (const dispose of disposals) dispose();
    for (const holder of [scenery, slot]) holder.replaceChildren();
  };
}

/** A new scene or rig replaces the picture; a new pose changes the paths it moves. */
function renderPicture(scenery: SVGSVGElement, slot: SVGGElement): () => void {
  let shown: Shown | null = null;
  let posed: Rig | null = null;
  const disposePicture = effect(() => {
    shown = scene.value ? shownOf(scene.value) : null;
    posed = null;
    scenery.replaceChildren(...(shown ? [takeScenery(shown.picture)] : []));
    slot.replaceChildren(...(shown ? [shown.picture.root] : []));
    const { layers } = untracked(() => edit.value);
    if (shown) showLayers(shown.picture, layers);
  });
  const disposeLayers = effect(() => {
    const { layers } = edit.value;
    if (shown) showLayers(shown.picture, layers);
  });
  const disposeFrames = eachFrame(() => {
    scene.value; // a new picture needs a frame even if the rig and the pose stay
    const current = rig.value;
    const now = standing.value;
    const isMoving = draft.value !== null || playing.value;
    if (!shown || !current || !now) return;
    const frame = current.frame(now.vertices, shown.picture.axes);
    if (posed === current) shown.writer.write(frame, isMoving);
    else shown.writer.writeAll(frame);
    posed = current;
    showOpenings(shown.picture, current.openings(now.vertices));
  });
  return () => {
    disposeFrames();
    disposeLayers();
    disposePicture();
  };
}

type Shown = { readonly picture: Picture; readonly writer: FrameWriter };

function shownOf(scene: Scene): Shown {
  const picture = pictureOf(scene);
  const fills = [...scene.back, ...scene.fore, ...scene.local].map(({ fill }) => fill);
  return { picture, writer: frameWriter(picture, fills) };
}

function showOpenings(picture: Picture, outlines: readonly string[]): void {
  OPENING_NAMES.forEach((name, index) => {
    writeAttribute(picture.openings[name], 'd', outlines[index]);
  });
}

function drawOverlay(overlay: Overlay): void {
  const landmarks = edit.value.landmarks;
  const now = standing.value;
  const current = rig.value;
  const isEditing = session.value.kind === 'editing' && !playing.value;
  const isDragged = draft.value !== null && hoveredTarget.value !== null;
  const shown = {
    points: isEditing && landmarksShown.value && landmarks !== null,
    mesh: isEditing && meshShown.value && current !== null,
    ghost: isEditing && (ghostShown.value || isDragged) && tool.value !== 'rest' && landmarks !== null,
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
    moving: draft.value !== null,
    shown,
  });
}

/** Runs `draw` before the next paint whenever what it read has changed. */
function eachFrame(draw: () => void): () => void {
  let cancel: (() => void) | null = null;
  let dispose = () => {};
  const run = () => {
    cancel = null;
    dispose();
    let isFirstRun = true;
    dispose = effect(() => {
      if (isFirstRun) draw();
      else cancel ??= beforePaint(run);
      isFirstRun = false;
    });
  };
  run();
  return () => {
    cancel?.();
    dispose();
  };
}
