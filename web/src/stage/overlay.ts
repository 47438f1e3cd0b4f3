/** Draws landmarks, groups, mesh, ghost and glowing triangles over the picture, in screen pixels, so that they keep their size. */
import { GROUPS, indicesOf, landmarkName, N_LANDMARKS } from '../face/ibug';
import { outerEyeDistance } from '../face/regions';
import { distance, type Xy } from '../face/vector';
import { svgElement, writeAttribute } from './svg';
import { type Size, toScreen, type View } from './view';

export type OverlayFrame = {
  readonly view: View;
  readonly stage: Size;
  /** 68 landmarks as they stand, and at rest, in portrait pixels. */
  readonly points: readonly Xy[];
  readonly rest: readonly Xy[];
  readonly irises: readonly Xy[];
  /** Flat vertices of the mesh as they stand, and its triangles as vertex indices. */
  readonly vertices: ArrayLike<number>;
  readonly triangles: ArrayLike<number>;
  /** Indices of the triangles that stop the pose. */
  readonly limiting: ArrayLike<number>;
  /** Whether an edit is under way: then dots stand in for the handles. */
  readonly moving: boolean;
  readonly shown: { readonly points: boolean; readonly mesh: boolean; readonly ghost: boolean };
};

export type Overlay = {
  readonly root: SVGGElement;
  readonly draw: (frame: OverlayFrame) => void;
  readonly highlight: (index: number | null) => void;
};

export function createOverlay(): Overlay {
  const mesh = svgElement('path', { class: 'mesh' });
  const limit = svgElement('path', { class: 'limit' });
  const ghost = svgElement('path', { class: 'ghost' });
  const halo = svgElement('path', { class: 'halo' });
  const outline = svgElement('path', { class: 'outline' });
  const rims = svgElement('path', { class: 'rims' });
  const dots = svgElement('path', { class: 'dots' });
  const irises = svgElement('path', { class: 'irises' });
  const handles = Array.from({ length: N_LANDMARKS }, (_, index) => handle(index));
  const groups = GROUPS.map((group) => {
    const holder = svgElement('g', { role: 'group', 'aria-label': group.label, class: `handles ${group.name}` });
    holder.append(...indicesOf(group).map((index) => handles[index]));
    return holder;
  });
  const root = svgElement('g', {});
  root.append(mesh, limit, ghost, halo, outline, irises, rims, dots, ...groups);
  const lit = litHandle(handles);

  function draw(frame: OverlayFrame): void {
    const screen = (points: readonly Xy[]) => points.map((point) => toScreen(frame.view, frame.stage, point));
    const points = screen(frame.points);
    const { shown } = frame;
    showParts(root, shown);
    if (shown.mesh) writeAttribute(mesh, 'd', trianglesPath(frame, undefined));
    writeAttribute(limit, 'd', frame.limiting.length > 0 ? trianglesPath(frame, frame.limiting) : '');
    if (shown.ghost) writeAttribute(ghost, 'd', groupsPath(screen(frame.rest)));
    if (!shown.points) return;
    const shape = groupsPath(points);
    for (const line of [halo, outline]) writeAttribute(line, 'd', shape);
    sizeHandles(root, handleRadius(points));
    writeAttribute(irises, 'd', screen(frame.irises).map(crossPath).join(''));
    root.classList.toggle('moving', frame.moving);
    const place = (index: number) => {
      writeAttribute(handles[index], 'transform', `translate(${decimals(points[index])})`);
    };
    if (frame.moving) {
      const places = points.map(dotPath).join('');
      for (const dot of [rims, dots]) writeAttribute(dot, 'd', places);
      lit.indices().forEach(place);
    } else for (const index of points.keys()) place(index);
  }

  return { root, draw, highlight: lit.set };
}

/** Says a handle's displacement to screen readers; called when a handle is focused or nudged, not every frame. */
export function describeHandle(element: Element, index: number, point: Xy, rest: Xy): void {
  const dx = Math.round((point[0] - rest[0]) * 10) / 10;
  const dy = Math.round((point[1] - rest[1]) * 10) / 10;
  element.setAttribute('aria-valuenow', `${Math.round(distance(point, rest) * 10) / 10}`);
  element.setAttribute('aria-valuetext', `${landmarkName(index)}: ${dx} right, ${dy} down`);
}

function handle(index: number): SVGCircleElement {
  return svgElement('circle', {
    class: 'handle',
    role: 'slider',
    tabindex: '-1',
    'data-landmark': `${index}`,
    'aria-label': landmarkName(index),
    'aria-valuemin': '0',
    'aria-valuemax': '1000',
    'aria-valuenow': '0',
    'aria-valuetext': 'at rest',
  });
}

/** A changed custom property restyles every handle, so it is written only when it differs. */
function sizeHandles(root: SVGGElement, radius: number): void {
  const size = `${radius.toFixed(1)}px`;
  if (root.style.getPropertyValue('--handle') !== size) root.style.setProperty('--handle', size);
}

/** Small faces get small handles, so that they stay faces. */
function handleRadius(screenPoints: readonly Xy[]): number {
  return Math.min(4, Math.max(1.6, 0.028 * outerEyeDistance(screenPoints)));
}

type LitHandle = {
  readonly set: (index: number | null) => void;
  /** The handles near the pointer and under the focus. */
  readonly indices: () => readonly number[];
};

function litHandle(handles: readonly SVGCircleElement[]): LitHandle {
  let lit: number | null = null;
  const set = (index: number | null) => {
    if (index === lit) return;
    if (lit !== null) handles[lit].classList.remove('near');
    if (index !== null) handles[index].classList.add('near');
    lit = index;
  };
  const indices = () => handles.flatMap((handle, index) => (index === lit || handle === document.activeElement ? [index] : []));
  return { set, indices };
}

function showParts(root: SVGGElement, shown: OverlayFrame['shown']): void {
  for (const [name, isShown] of Object.entries(shown)) root.classList.toggle(`with-${name}`, isShown);
}

function groupsPath(points: readonly Xy[]): string {
  return GROUPS.map(
    (group) =>
      `M${indicesOf(group)
        .map((index) => decimals(points[index]))
        .join('L')}${group.closed ? 'Z' : ''}`,
  ).join('');
}

function trianglesPath({ vertices, triangles, view, stage }: OverlayFrame, only: ArrayLike<number> | undefined): string {
  const corner = (vertex: number) => decimals(toScreen(view, stage, [vertices[2 * vertex], vertices[2 * vertex + 1]]));
  const count = only ? only.length : triangles.length / 3;
  const parts: string[] = [];
  for (let k = 0; k < count; k += 1) {
    const first = 3 * (only ? only[k] : k);
    parts.push(`M${corner(triangles[first])}L${corner(triangles[first + 1])}L${corner(triangles[first + 2])}Z`);
  }
  return parts.join('');
}

const ARM = 5; // screen pixels of the cross on an iris
/** A line without length: its round cap is the dot. */
const dotPath = (point: Xy) => `M${decimals(point)}h0`;
const crossPath = ([x, y]: Xy) => `M${x - ARM} ${y}H${x + ARM}M${x} ${y - ARM}V${y + ARM}`;
const decimals = ([x, y]: Xy) => `${x.toFixed(1)} ${y.toFixed(1)}`;
