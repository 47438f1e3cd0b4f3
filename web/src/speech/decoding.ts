/** A sound file becomes samples, by the browser's own decoder. */
import { FileError } from '../store/notices';
import { peaksOf, type Samples } from './envelope';

/** `mono` is the mean of the channels of `buffer`, which is what plays; `loudest` its largest magnitude. */
export type Sound = { readonly buffer: AudioBuffer; readonly mono: Samples; readonly loudest: number };

export const MAX_SECONDS = 600;
export const MAX_BYTES = 64_000_000; // what a project file holds; 10 minutes of 16-bit mono at 48 kHz have 58 MB
const RATE = 48_000; // what sound cards run at, so that playing resamples nothing

/** Throws a `FileError` for what is too large, too long, or no sound that this browser knows. */
export async function decodeSound(file: Blob, name: string): Promise<Sound> {
  if (file.size > MAX_BYTES)
    throw new FileError(`${name} has ${Math.round(file.size / 1e6)} MB; the limit is ${MAX_BYTES / 1e6} MB. Cut it, or save it as MP3.`);
  const buffer = await decoded(await file.arrayBuffer(), name);
  if (buffer.duration > MAX_SECONDS)
    throw new FileError(`${name} lasts ${clock(buffer.duration)}; the limit is ${MAX_SECONDS / 60} minutes. Cut it and try again.`);
  const mono = { values: mixed(buffer), rate: buffer.sampleRate };
  return { buffer, mono, loudest: peaksOf(mono, 0, buffer.duration, 1)[0] };
}

async function decoded(data: ArrayBuffer, name: string): Promise<AudioBuffer> {
  try {
    return await new OfflineAudioContext(1, 1, RATE).decodeAudioData(data);
  } catch {
    throw new FileError(`${name} is no sound that this browser can play: save it as WAV or MP3 and try again.`);
  }
}

function mixed(buffer: AudioBuffer): Float32Array {
  const first = buffer.getChannelData(0);
  if (buffer.numberOfChannels === 1) return first;
  const second = buffer.getChannelData(1);
  return first.map((value, at) => (value + second[at]) / 2);
}

const clock = (seconds: number) => `${Math.floor(seconds / 60)}:${String(Math.floor(seconds % 60)).padStart(2, '0')} minutes`;
