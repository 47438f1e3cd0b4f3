/** Turns frames painted on a canvas into an MP4 or WebM file, by WebCodecs. */
import type { Output, VideoCodec } from 'mediabunny';
import { evenSize, type PixelSize, paintFrame } from './canvas';
import { addCaptions } from './captionTrack';
import { fileFormat, MEDIA_TYPES, type VideoKind } from './container';
import { type Drawing, drawingOf, frameOf, restFrame } from './drawing';
import { frameCount, type Performance, verticesAt } from './motion';
import { addSound, soundCodec } from './soundTrack';

export type VideoOptions = { readonly kind: VideoKind; readonly fps: number; readonly longerSide: number };

const CODECS: Readonly<Record<VideoKind, VideoCodec>> = { mp4: 'avc', webm: 'vp9' };
const KEY_FRAME_SECONDS = 2;

/** Whether this browser really encodes `kind` at `size`: a supported configuration may still fail, so one frame is encoded. */
export async function canEncode(kind: VideoKind, size: PixelSize): Promise<boolean> {
  if (!('VideoEncoder' in window)) return false;
  const canvas = new OffscreenCanvas(size.width, size.height);
  if (!canvas.getContext('2d', { alpha: false })) return false;
  try {
    const encoding = await startEncoding(canvas, kind, 25, SILENT);
    await encoding.add(0);
    return (await encoding.finish()).size > 0;
  } catch {
    return false; // whatever an encoder throws, the answer is no, and the person is offered another way
  }
}

/** Encodes all frames of the track, and its sound. Aborting rejects with the signal's reason. */
export async function encodeVideo(
  performance: Performance,
  { kind, fps, longerSide }: VideoOptions,
  signal: AbortSignal,
  onProgress: (share: number) => void,
): Promise<Blob> {
  const count = frameCount(performance, fps);
  return encodeFrames(performance, { kind, fps, longerSide }, { from: 0, to: count }, signal, (done) => onProgress(done / count));
}

/** Encodes the frames `from` … `to` − 1 as a file of their own; sound goes along from its start. */
export async function encodeFrames(
  performance: Performance,
  { kind, fps, longerSide }: VideoOptions,
  { from, to }: { readonly from: number; readonly to: number },
  signal: AbortSignal,
  onFrame: (done: number) => void,
): Promise<Blob> {
  const drawing: Drawing = drawingOf(performance.scene);
  const rest = restFrame(performance.rig, drawing);
  const size = evenSize(drawing, longerSide);
  const canvas = new OffscreenCanvas(size.width, size.height);
  const context = canvas.getContext('2d', { alpha: false });
  if (!context) throw new Error('This browser gives no 2D canvas.');
  const encoding = await startEncoding(canvas, kind, fps, performance);
  try {
    for (let frame = from; frame < to; frame++) {
      signal.throwIfAborted();
      paintFrame(context, drawing, performance.layers, frameOf(performance.rig, drawing, rest, verticesAt(performance, frame / fps)));
      await encoding.add(frame - from);
      onFrame(frame - from + 1);
      await pageTurn();
    }
    return await encoding.finish();
  } catch (error) {
    await encoding.cancel();
    throw error;
  }
}

type Spoken = Pick<Performance, 'sound' | 'captions'>;
const SILENT: Spoken = { sound: null, captions: [] };

type Encoding = {
  /** Adds what is on the canvas as frame `index`. */
  readonly add: (index: number) => Promise<void>;
  readonly finish: () => Promise<Blob>;
  readonly cancel: () => Promise<void>;
};

async function startEncoding(canvas: OffscreenCanvas, kind: VideoKind, fps: number, { sound, captions }: Spoken): Promise<Encoding> {
  const { BufferTarget, CanvasSource, Output, QUALITY_HIGH } = await import('mediabunny');
  const format = await fileFormat(kind);
  const target = new BufferTarget();
  const output: Output = new Output({ format, target });
  const source = new CanvasSource(canvas, { codec: CODECS[kind], bitrate: QUALITY_HIGH, keyFrameInterval: KEY_FRAME_SECONDS });
  output.addVideoTrack(source, { frameRate: fps });
  const codec = sound && (await soundCodec(kind, sound));
  const speak = sound && codec ? await addSound(output, codec, sound) : () => Promise.resolve();
  const caption = await addCaptions(output, captions);
  await output.start();
  await caption();
  return {
    add: async (index) => {
      await source.add(index / fps, 1 / fps);
      await speak((index + 1) / fps);
    },
    finish: async () => {
      await output.finalize();
      if (!target.buffer) throw new Error('The encoder gave no file.');
      return new Blob([target.buffer], { type: MEDIA_TYPES[kind] });
    },
    cancel: () => output.cancel(),
  };
}

/** Lets the page answer clicks and paint between frames. */
function pageTurn(): Promise<void> {
  return new Promise((resolve) => {
    const { port1, port2 } = new MessageChannel();
    port1.onmessage = () => resolve();
    port2.postMessage(null);
  });
}
