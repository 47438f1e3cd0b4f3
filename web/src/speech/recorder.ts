/** Records from the microphone: asking, refused, recording with a level, stopped. */
import { signal } from '@preact/signals';
import { FileError, report } from '../store/notices';
import { MAX_SECONDS } from './decoding';
import { takeSound } from './listening';

export type Recorder =
  | { readonly kind: 'idle' }
  | { readonly kind: 'asking' }
  | { readonly kind: 'refused'; readonly reason: string }
  | { readonly kind: 'recording' };

export const recorder = signal<Recorder>({ kind: 'idle' });

/** Seconds so far, and how loud it is now, 0 to 1. */
export const meter = signal({ seconds: 0, level: 0 });

const FORMATS = ['audio/webm;codecs=opus', 'audio/mp4', 'audio/ogg;codecs=opus'];
const REASONS: Readonly<Record<string, string>> = {
  NotAllowedError: 'The browser may not use the microphone. Allow it beside the address of this page, then record again.',
  NotFoundError: 'No microphone was found. Plug one in, then record again.',
  NotReadableError: 'Another program holds the microphone. Close it, then record again.',
};
const QUIETEST_DB = -50; // the left end of the meter

let stop = () => {};

export async function startRecording(): Promise<void> {
  recorder.value = { kind: 'asking' };
  try {
    if (!navigator.mediaDevices)
      throw new FileError('Browsers record only on secure pages: open the editor by https, or on its own computer.');
    record(await navigator.mediaDevices.getUserMedia({ audio: true }));
  } catch (error) {
    const reason = error instanceof DOMException ? REASONS[error.name] : undefined;
    recorder.value = reason ? { kind: 'refused', reason } : { kind: 'idle' };
    if (!reason) report(error);
  }
}

/** The recording so far becomes the sound of the portrait. */
export function stopRecording(): void {
  stop();
}

function record(stream: MediaStream): void {
  const media = new MediaRecorder(stream, { mimeType: FORMATS.find((format) => MediaRecorder.isTypeSupported(format)) });
  const pieces: Blob[] = [];
  const stopMeter = startMeter(stream, () => media.stop());
  media.ondataavailable = ({ data }) => pieces.push(data);
  media.onstop = () => {
    stopMeter();
    for (const input of stream.getTracks()) input.stop();
    recorder.value = { kind: 'idle' };
    takeSound(new Blob(pieces, { type: media.mimeType }), 'Recording').catch(report);
  };
  stop = () => media.state === 'recording' && media.stop();
  media.start();
  recorder.value = { kind: 'recording' };
}

/** Keeps `meter` up to date until the returned function is called, and calls `onFull` at the limit. */
function startMeter(stream: MediaStream, onFull: () => void): () => void {
  const context = new AudioContext();
  const analyser = context.createAnalyser();
  context.createMediaStreamSource(stream).connect(analyser);
  const window = new Float32Array(analyser.fftSize);
  const start = performance.now();
  let request = requestAnimationFrame(function measure() {
    analyser.getFloatTimeDomainData(window);
    const power = window.reduce((sum, value) => sum + value * value, 0) / window.length;
    const seconds = (performance.now() - start) / 1000;
    meter.value = { seconds, level: Math.max(0, 1 - (10 * Math.log10(power + 1e-12)) / QUIETEST_DB) };
    if (seconds >= MAX_SECONDS) return onFull();
    request = requestAnimationFrame(measure);
  });
  return () => {
    cancelAnimationFrame(request);
    context.close().catch(report);
  };
}
