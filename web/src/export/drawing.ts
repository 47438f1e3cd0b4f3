/** Turns a scene into what all frames of an animation share: fills, clips and gradient ends as flat arrays. */
import type { LocalPath, Scene, ScenePath, Stop } from '../api/schema';
import type { CorePicture, Rig } from '../rig/rig';
import type { LayerName } from '../store/edit';

type Fill = ScenePath['fill'];

/** Left eye 0, right eye 1, mouth 2. */
const OPENING_OF_PART: Readonly<Record<LocalPath['part'], number>> = {
  left_eye: 0,
  left_iris: 0,
  right_eye: 1,
  right_iris: 1,
  mouth_cavity: 2,
  mouth_lower: 2,
  tongue: 2,
  mouth_upper: 2,
};

/** A scene's paths in painter's order; `openings[i]` clips path i, null outside the local layer. */
export type Drawing = {
  readonly width: number;
  readonly height: number;
  readonly canvas: string;
  readonly fills: readonly Fill[];
  /** First path of each layer, and the one after its last. */
  readonly ranges: Readonly<Record<LayerName, readonly [number, number]>>;
  readonly openings: readonly (number | null)[];
  /** Gradient ends x1, y1, x2, y2 of every path at rest; zeros for solid fills. */
  readonly axes: Float64Array;
  readonly core: CorePicture;
};

/** Control points x, y, … of all paths and openings, and gradient ends of all paths, at an instant. */
export type DrawingFrame = {
  readonly paths: readonly Float64Array[];
  readonly axes: readonly Float64Array[];
  readonly openings: readonly Float64Array[];
};

export function drawingOf(scene: Scene): Drawing {
  const { width, height, canvas, back, fore, local } = scene;
  const fills = [...back, ...fore, ...local].map(({ fill }) => fill);
  const clips = local.map(({ part }) => OPENING_OF_PART[part]);
  const axes = Float64Array.from(fills.flatMap((fill) => (fill.kind === 'linear' ? [...fill.start, ...fill.end] : [0, 0, 0, 0])));
  return {
    width,
    height,
    canvas,
    fills,
    ranges: rangesOf(scene),
    openings: [...back.map(() => null), ...fore.map(() => null), ...clips],
    axes,
    core: {
      width,
      height,
      canvas: Uint8Array.from(bytesOf(canvas)),
      layers: Uint32Array.of(back.length, fore.length),
      openings: Uint32Array.from(clips),
      fills: Float64Array.from(fills.flatMap(fillNumbers)),
      axes,
    },
  };
}

function rangesOf({ back, fore, local }: Scene): Drawing['ranges'] {
  const head = back.length + fore.length;
  return { back: [0, back.length], fore: [back.length, head], local: [head, head + local.length] };
}

/** The frame of posed vertices. Paths that did not move share their rest points. */
export function frameOf(rig: Rig, drawing: Drawing, rest: DrawingFrame, vertices: Float64Array): DrawingFrame {
  const paths = [...rest.paths];
  const axes = [...rest.axes];
  for (const moved of rig.movedPoints(vertices, drawing.axes)) {
    paths[moved.path] = moved.points;
    axes[moved.path] = moved.axis;
  }
  return { paths, axes, openings: rig.openingPoints(vertices) };
}

export function restFrame(rig: Rig, drawing: Drawing): DrawingFrame {
  return {
    paths: drawing.fills.map((_, path) => rig.restPoints(path)),
    axes: drawing.fills.map((_, path) => drawing.axes.subarray(4 * path, 4 * path + 4)),
    openings: rig.openingPoints(rig.restVertices),
  };
}

/** `#rrggbb` and an opacity as a CSS colour. */
export function cssColour({ colour, opacity }: Pick<Stop, 'colour' | 'opacity'>): string {
  return opacity === 1 ? colour : `rgb(${bytesOf(colour).join(' ')} / ${opacity})`;
}

function fillNumbers(fill: Fill): number[] {
  const stops = (fill.kind === 'linear' ? fill.stops : [fill, fill, fill]).map(({ colour, opacity }) => [...bytesOf(colour), opacity]);
  return [fill.kind === 'linear' ? 1 : 0, ...withMiddle(stops).flat()];
}

/** Three stops that paint as two or three do: between two comes their mean. */
function withMiddle(stops: number[][]): number[][] {
  if (stops.length === 3) return stops;
  const [first, last] = stops;
  return [first, first.map((value, channel) => (value + last[channel]) / 2), last];
}

const bytesOf = (colour: string) => [1, 3, 5].map((at) => Number.parseInt(colour.slice(at, at + 2), 16));
