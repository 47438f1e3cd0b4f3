/** The rig in WASM as typed functions: a scene and its rest landmarks in, vertices, changed paths and path data out. */
import type { Landmarks, LocalPath, Pose, Scene } from '../api/schema';
import initModule, { Rig as CoreRig, channelNames, fitPins as coreFitPins, pathData as corePathData } from './wasm/vectortalker_browser.js';

type Xy = readonly [number, number];

/** Image-left eye, image-right eye, nose tip, image-left and image-right mouth corner, in portrait pixels. */
export type Pins = readonly [Xy, Xy, Xy, Xy, Xy];

/** How far a pose was carried out, and which triangles stopped it: indices into `Rig.triangles` by threes. */
export type Limit = { readonly scale: number; readonly triangles: readonly number[] };

export type Posed = { readonly vertices: Float64Array; readonly limit: Limit };

/** What a new pose changes; path indices run through back, fore and local in painter's order. */
export type Frame = {
  readonly changed: Uint32Array;
  /** SVG path data of any path, changed or not. */
  readonly d: (pathIndex: number) => string;
  /** Where the ends x1, y1, x2, y2 of the gradients of the changed paths go, four numbers each. */
  readonly axes: Float64Array;
};

/** Flat control points of one path of a frame, and where the ends x1, y1, x2, y2 of its gradient go with it. */
export type FramePoints = { readonly path: number; readonly points: Float64Array; readonly axis: Float64Array };

/** A scene's fills and clips as flat arrays; see the core's `animatedSvg`. */
export type CorePicture = {
  readonly width: number;
  readonly height: number;
  readonly canvas: Uint8Array;
  readonly layers: Uint32Array;
  readonly openings: Uint32Array;
  readonly fills: Float64Array;
  readonly axes: Float64Array;
};

export type SvgOptions = {
  readonly durationSeconds: number;
  /** Largest distance of a control point from where its frame has it, in portrait pixels. */
  readonly tolerance: number;
  readonly looped: boolean;
  readonly title: string;
  readonly description: string;
};

export type RigOptions = {
  /** Split curves at triangle edges; false is the ablation of the paper's figure. */
  readonly split?: boolean;
  /** Repair kinks where smooth curves pass from one triangle to the next. */
  readonly smooth?: boolean;
};

const LOCAL_LAYER = 2; // the core counts 0 back, 1 fore, 2 + part
const PART_NUMBERS: Readonly<Record<LocalPath['part'], number>> = {
  left_eye: 0,
  right_eye: 1,
  left_iris: 2,
  right_iris: 3,
  mouth_cavity: 4,
  mouth_lower: 5,
  tongue: 6,
  mouth_upper: 7,
};
const N_LANDMARKS = 68;
const N_OPENINGS = 3;

let channelPlaces: ReadonlyMap<string, number> | null = null;

/** Loads the WASM module once; `source` gives its bytes where they cannot be fetched by address. */
export async function loadRigModule(source?: BufferSource): Promise<void> {
  await initModule({ module_or_path: source ?? new URL('./wasm/vectortalker_browser_bg.wasm', import.meta.url) });
  channelPlaces = new Map(channelNames().map((name, place) => [name, place]));
}

/** Builds the rig of a scene; throws the core's message when the landmarks span no face. */
export function buildRig(scene: Scene, landmarks: Landmarks, options: RigOptions = {}): Rig {
  const paths = [...scene.back, ...scene.fore, ...scene.local];
  const layers = [
    ...scene.back.map(() => 0),
    ...scene.fore.map(() => 1),
    ...scene.local.map(({ part }) => LOCAL_LAYER + PART_NUMBERS[part]),
  ];
  const core = new CoreRig(
    scene.width,
    scene.height,
    concatenated(paths.map(({ points }) => points)),
    Uint32Array.from(paths, ({ points }) => points.length / 6),
    Uint8Array.from(layers),
    Float64Array.from(landmarks.points.flat()),
    Float64Array.from((landmarks.irises ?? []).flatMap(({ centre, radius }) => [...centre, radius])),
    Float64Array.from(landmarks.depth ?? []),
    options.split ?? true,
    options.smooth ?? true,
  );
  return new Rig(core);
}

/** 68 landmarks and two irises for five pins; null when the pins coincide. */
export function fitPins(pins: Pins): Landmarks | null {
  const fit = coreFitPins(Float64Array.from(pins.flat()));
  if (fit.length === 0) return null;
  const points = Array.from({ length: N_LANDMARKS }, (_, index): [number, number] => [fit[2 * index], fit[2 * index + 1]]);
  const iris = (from: number) => ({ centre: [fit[from], fit[from + 1]] as [number, number], radius: fit[from + 2] });
  return { points, irises: [iris(2 * N_LANDMARKS), iris(2 * N_LANDMARKS + 3)] };
}

/** SVG path data of a closed chain of cubics. */
export function pathData(points: Float64Array): string {
  return corePathData(points);
}

/** A rigged scene. Its topology never changes; it remembers the last frame, so that a frame lists only what differs from it. */
export class Rig {
  readonly #core: CoreRig;
  readonly restVertices: Float64Array;
  /** Vertex indices, three a triangle. */
  readonly triangles: Uint32Array;
  readonly pathCount: number;
  #shown: Float64Array;
  readonly #data: (string | undefined)[];

  constructor(core: CoreRig) {
    this.#core = core;
    this.restVertices = core.restVertices;
    this.triangles = core.triangles;
    this.pathCount = core.pathCount;
    this.#shown = this.restVertices;
    this.#data = new Array(this.pathCount);
  }

  /** Flat vertices of a pose: 68 landmarks, two irises, then the rig's own. Channels this version does not know are left out. */
  vertices(pose: Pose): Posed {
    const posed = this.#core.vertices(articulatorsOf(pose), Float64Array.from(pose.offsets?.flat() ?? []));
    const result = { vertices: posed.positions, limit: { scale: posed.scale, triangles: [...posed.triangles] } };
    posed.free();
    return result;
  }

  /** Paths that differ from the frame before (the first time: from rest), with their path data; `axes` as in `movedPoints`. */
  frame(vertices: Float64Array, axes: Float64Array): Frame {
    const frame = this.#core.frameData(vertices, this.#shown, axes);
    const { changed, text, ends, axes: moved } = frame;
    frame.free();
    let start = 0;
    changed.forEach((path, k) => {
      this.#data[path] = text.slice(start, ends[k]);
      start = ends[k];
    });
    this.#shown = vertices.slice();
    return { changed, d: (path) => this.#pathData(path), axes: moved };
  }

  /** All paths that differ from rest; `axes` are the gradient ends of every path at rest, four numbers each. */
  movedPoints(vertices: Float64Array, axes: Float64Array = new Float64Array(4 * this.pathCount)): readonly FramePoints[] {
    const frame = this.#core.framePoints(vertices, this.restVertices, axes);
    const { changed, starts, points, axes: moved } = frame;
    frame.free();
    return Array.from(changed, (path, k) => ({
      path,
      points: points.subarray(2 * starts[k], 2 * starts[k + 1]),
      axis: moved.subarray(4 * k, 4 * k + 4),
    }));
  }

  /** Animated SVG of `frames` (all vertices, frame after frame, evenly over the duration). */
  animatedSvg({ width, height, canvas, layers, openings, fills, axes }: CorePicture, frames: Float64Array, options: SvgOptions): string {
    const { durationSeconds, tolerance, looped, title, description } = options;
    return this.#core.animatedSvg(
      width,
      height,
      canvas,
      layers,
      openings,
      fills,
      axes,
      frames,
      durationSeconds,
      tolerance,
      looped,
      title,
      description,
    );
  }

  /** Control points of one path at rest, split as in every frame. */
  restPoints(path: number): Float64Array {
    return this.#core.restPath(path);
  }

  /** Path data of the openings: left eye, right eye, mouth. */
  openings(vertices: Float64Array): readonly string[] {
    return this.openingPoints(vertices).map((points) => corePathData(points));
  }

  /** Control points of the openings: left eye, right eye, mouth. */
  openingPoints(vertices: Float64Array): readonly Float64Array[] {
    return Array.from({ length: N_OPENINGS }, (_, opening) => this.#core.opening(opening, vertices));
  }

  /** Gives the rig's memory back; the rig must not be used afterwards. */
  dispose(): void {
    this.#core.free();
  }

  #pathData(path: number): string {
    const known = this.#data[path] ?? corePathData(this.#core.restPath(path));
    this.#data[path] = known;
    return known;
  }
}

function articulatorsOf(pose: Pose): Float64Array {
  if (!channelPlaces) throw new Error('The rig module is not loaded.');
  const values = new Float64Array(channelPlaces.size);
  for (const [name, value] of Object.entries(pose.articulators)) {
    const place = channelPlaces.get(name);
    if (place !== undefined) values[place] = value;
  }
  return values;
}

function concatenated(lists: readonly (readonly number[])[]): Float64Array {
  const flat = new Float64Array(lists.reduce((length, list) => length + list.length, 0));
  let from = 0;
  for (const list of lists) {
    flat.set(list, from);
    from += list.length;
  }
  return flat;
}
