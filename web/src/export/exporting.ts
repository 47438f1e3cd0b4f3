/** One export at a time: what may be exported, how it is going, and how it ends. */
import { signal as state } from '@preact/signals';
import { download } from '../project/files';
import { buildRig } from '../rig/rig';
import { webVtt } from '../speech/captions';
import { mediaTypeOf } from '../speech/clips';
import { clip, sound } from '../speech/sound';
import { captions } from '../speech/state';
import { rigModuleReady, standing } from '../stage/posing';
import { announce, report } from '../store/notices';
import { edit, history, scene, track } from '../store/state';
import type { SvgTiming } from './animatedSvg';
import { evenSize } from './canvas';
import type { VideoKind } from './container';
import { type Forecast, forecastVideo } from './forecast';
import { areOpaque, shownScene } from './layerLooks';
import type { Performance, Score } from './motion';
import { pageFile } from './pageFile';
import { renderOnServer } from './serverVideo';
import { soundCodec } from './soundTrack';
import { stillSvg } from './svgFile';
import { forecastAnimatedSvg, writeAnimatedSvg } from './svgThread';
import { canEncode, encodeVideo, type VideoOptions } from './videoFile';

export type ExportKind = 'svg' | 'animated' | 'page' | 'mp4' | 'webm' | 'captions';

/** Where a video would be made. */
export type Maker = 'browser' | 'server';

export type Exporting =
  | { readonly kind: 'idle' }
  | { readonly kind: 'measuring'; readonly what: ExportKind }
  | {
      readonly kind: 'ready';
      readonly what: ExportKind;
      readonly forecast: Forecast | null;
      /** What it would be in full, where it is made lighter. */
      readonly inFull: Forecast | null;
      readonly maker: Maker;
      readonly note: string | null;
    }
  | { readonly kind: 'working'; readonly what: ExportKind; readonly progress: number };

const FPS = 25;
const BASE64_GROWTH = 4 / 3;
const LIGHTER = 3; // times the tolerance: a pixel and a half of a portrait of 1024

export const exporting = state<Exporting>({ kind: 'idle' });
/** Longer side of a video in pixels. */
export const videoSize = state(512);
export const looped = state(true);

let stopper = new AbortController();

/** Probes and samples; ends in `ready`, from where `start` goes on, or `prepareLighter` for animated SVG. */
export async function prepare(what: ExportKind): Promise<void> {
  await makeReady(what, null);
}

/** The same with fewer keyframes. */
export async function prepareLighter(): Promise<void> {
  const now = exporting.value;
  if (now.kind === 'ready') await makeReady(now.what, now.forecast);
}

async function makeReady(what: ExportKind, inFull: Forecast | null): Promise<void> {
  const { signal } = begin({ kind: 'measuring', what });
  await attempt(signal, async () => {
    await painted();
    const { forecast, maker } = await measured(what, svgTiming(inFull), signal);
    const note = [await soundNote(what), layerNote(maker)].filter(Boolean).join(' ') || null;
    if (!signal.aborted) exporting.value = { kind: 'ready', what, forecast, inFull, maker, note };
  });
}

/** Makes the file that was prepared and hands it to the browser's downloads. */
export async function start(): Promise<void> {
  const ready = exporting.value;
  if (ready.kind !== 'ready') return;
  const { what, maker, forecast, inFull } = ready;
  const { signal } = begin({ kind: 'working', what, progress: 0 });
  await attempt(signal, async () => {
    await painted();
    const file = await made({ what, maker, forecast, timing: svgTiming(inFull) }, signal);
    download(file.data, file.name);
    announce(`Exported ${file.name}`);
    exporting.value = { kind: 'idle' };
  });
}

/** Stops whatever is under way. */
export function cancel(): void {
  stopper.abort();
  exporting.value = { kind: 'idle' };
}

function begin(next: Exporting): AbortController {
  stopper.abort();
  stopper = new AbortController();
  exporting.value = next;
  return stopper;
}

async function attempt(signal: AbortSignal, work: () => Promise<void>): Promise<void> {
  try {
    await work();
  } catch (error) {
    if (signal.aborted) return;
    exporting.value = { kind: 'idle' };
    report(error);
  }
}

async function measured(what: ExportKind, timing: SvgTiming, signal: AbortSignal): Promise<{ forecast: Forecast | null; maker: Maker }> {
  switch (what) {
    case 'svg':
      return { forecast: { bytes: still().length, seconds: 0 }, maker: 'browser' };
    case 'captions':
      return { forecast: { bytes: webVtt(captions.value).length, seconds: 0 }, maker: 'browser' };
    case 'animated':
      return { forecast: await forecastAnimatedSvg(score(), timing, signal), maker: 'browser' };
    case 'page': {
      const { bytes, seconds } = await forecastAnimatedSvg(score(), timing, signal);
      return { forecast: { bytes: bytes + BASE64_GROWTH * (clip.value?.data.size ?? 0), seconds }, maker: 'browser' };
    }
    case 'mp4':
    case 'webm': {
      const options = videoOptions(what);
      const isAble = scene.value !== null && (await canEncode(what, evenSize(scene.value, options.longerSide)));
      if (!isAble) return { forecast: null, maker: 'server' };
      return { forecast: await onStage((performance) => forecastVideo(performance, options, signal)), maker: 'browser' };
    }
    default:
      return what satisfies never;
  }
}

/** What becomes of the sound, where it is not as people would expect. */
async function soundNote(what: ExportKind): Promise<string | null> {
  const spoken = sound.value?.buffer;
  if (!spoken || what === 'svg' || what === 'page' || what === 'captions') return null;
  if (what === 'animated') return 'Without sound: an SVG has none. It is in step when both are started together.';
  const codec = await soundCodec(what, spoken);
  if (!codec) return 'Without sound: this browser cannot encode any.';
  return what === 'mp4' && codec === 'opus' ? 'Sound as Opus: browsers and VLC play it, QuickTime may stay silent.' : null;
}

/** The server knows scenes only: hidden layers are left out of them, but all others are opaque. */
function layerNote(maker: Maker): string | null {
  return maker === 'server' && !areOpaque(edit.value.layers) ? 'Layers come out opaque: the server paints no see-through layers.' : null;
}

type Making = { readonly what: ExportKind; readonly maker: Maker; readonly forecast: Forecast | null; readonly timing: SvgTiming };

async function made({ what, maker, forecast, timing }: Making, signal: AbortSignal): Promise<{ data: Blob; name: string }> {
  const { name } = edit.value;
  switch (what) {
    case 'svg':
      return { data: new Blob([still()], { type: 'image/svg+xml' }), name: `${name}.svg` };
    case 'captions':
      return { data: new Blob([webVtt(captions.value)], { type: 'text/vtt' }), name: `${name}.vtt` };
    case 'animated':
    case 'page': {
      const spoken = what === 'page' ? clip.value : null;
      const onProgress = (progress: number) => tell(what, progress, signal);
      const turns = { ...timing, looped: looped.value && !spoken }; // the sound repeats, and the picture follows it
      const text = await writeAnimatedSvg(score(), turns, forecast?.seconds ?? 0, signal, onProgress);
      if (what === 'animated') return { data: new Blob([text], { type: 'image/svg+xml' }), name: `${name}-animated.svg` };
      const pageSound = spoken && {
        data: spoken.data,
        mediaType: mediaTypeOf(spoken.name),
        looped: looped.value,
        captions: captions.value,
      };
      return { data: new Blob([await pageFile(text, name, pageSound)], { type: 'text/html' }), name: `${name}.html` };
    }
    case 'mp4':
    case 'webm': {
      const make = maker === 'browser' ? encodeVideo : renderOnServer;
      const data = await onStage((performance) =>
        make(performance, videoOptions(what), signal, (progress) => tell(what, progress, signal)),
      );
      return { data, name: `${name}.${what}` };
    }
    default:
      return what satisfies never;
  }
}

function tell(what: ExportKind, progress: number, signal: AbortSignal): void {
  if (!signal.aborted) exporting.value = { kind: 'working', what, progress };
}

const svgTiming = (inFull: Forecast | null): SvgTiming => ({
  looped: looped.value,
  durationSeconds: track.value?.duration ?? 0,
  coarseness: inFull ? LIGHTER : 1,
});
const videoOptions = (kind: VideoKind): VideoOptions => ({ kind, fps: FPS, longerSide: videoSize.value });

function score(): Score {
  const { name, landmarks, pose, layers } = history.value.present;
  if (!scene.value || !landmarks || !track.value) throw new Error('Choose a track first: there is nothing to play.');
  return { name, scene: shownScene(scene.value, layers), landmarks, layers, pose, track: track.value, captions: captions.value };
}

/** Gives `use` a rig of its own: the stage's remembers what it shows. The rig is freed when the result is there. */
async function onStage<T>(use: (performance: Performance) => Promise<T>): Promise<T> {
  if (!rigModuleReady.value) throw new Error('The rig is still being loaded: try again in a moment.');
  const playing = score();
  const rig = buildRig(playing.scene, playing.landmarks);
  try {
    return await use({ ...playing, rig, sound: sound.value?.buffer ?? null });
  } finally {
    rig.dispose();
  }
}

/** The picture as it stands on the stage. */
function still(): string {
  if (!scene.value) throw new Error('There is no vector picture to export yet.');
  const { landmarks } = history.value.present;
  const { name, layers } = edit.value;
  const now = standing.value;
  if (!landmarks || !now) return stillSvg(name, scene.value, null, layers);
  const rig = buildRig(scene.value, landmarks);
  try {
    return stillSvg(name, scene.value, { rig, vertices: now.vertices }, layers);
  } finally {
    rig.dispose();
  }
}

/** Resolves after the next paint, so that long work starts with the page up to date. */
const painted = () => new Promise<void>((resolve) => requestAnimationFrame(() => setTimeout(resolve)));
