/** Puts sound into a video file: which codec this browser really encodes, and slices of the sound as the pictures come. */
import type { AudioCodec, Output } from 'mediabunny';
import { fileFormat, type VideoKind } from './container';

/** AAC plays everywhere; Opus in MP4 in browsers and most players. */
const CODECS: Readonly<Record<VideoKind, readonly AudioCodec[]>> = { mp4: ['aac', 'opus'], webm: ['opus'] };
const PROBE_SECONDS = 0.1;

/** About what a file grows by, in bytes a second. */
export const SOUND_BYTES_PER_SECOND = 16_000;

/** The first codec that encodes a piece of `sound`, as supported configurations may still fail; null where none does. */
export async function soundCodec(kind: VideoKind, sound: AudioBuffer): Promise<AudioCodec | null> {
  if (!('AudioEncoder' in window)) return null;
  for (const codec of CODECS[kind]) if (await encodes(kind, codec, sound)) return codec;
  return null;
}

async function encodes(kind: VideoKind, codec: AudioCodec, sound: AudioBuffer): Promise<boolean> {
  const { BufferTarget, Output } = await import('mediabunny');
  const output = new Output({ format: await fileFormat(kind), target: new BufferTarget() });
  try {
    const feed = await addSound(output, codec, sound);
    await output.start();
    await feed(PROBE_SECONDS);
    await output.finalize();
    return true;
  } catch {
    return false; // whatever an encoder throws, the answer is no, and the next codec is tried
  }
}

/** Adds a sound track to an output that has not started. The result encodes `sound` up to a time in seconds. */
export async function addSound(output: Output, codec: AudioCodec, sound: AudioBuffer): Promise<(until: number) => Promise<void>> {
  const { AudioBufferSource, QUALITY_HIGH } = await import('mediabunny');
  const source = new AudioBufferSource({ codec, quality: QUALITY_HIGH });
  output.addAudioTrack(source);
  let done = 0;
  return async (until) => {
    const end = Math.min(sound.length, Math.round(until * sound.sampleRate));
    if (end <= done) return;
    await source.add(slice(sound, done, end));
    done = end;
  };
}

function slice(sound: AudioBuffer, from: number, to: number): AudioBuffer {
  const { numberOfChannels, sampleRate } = sound;
  const piece = new AudioBuffer({ length: to - from, numberOfChannels, sampleRate });
  for (let channel = 0; channel < numberOfChannels; channel++)
    piece.copyToChannel(sound.getChannelData(channel).subarray(from, to), channel);
  return piece;
}
