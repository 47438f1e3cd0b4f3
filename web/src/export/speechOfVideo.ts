/** Adds sound and captions to a video that was made elsewhere, its pictures as they are. */
import { addCaptions } from './captionTrack';
import { fileFormat, MEDIA_TYPES, type VideoKind } from './container';
import type { Performance } from './motion';
import { addSound, soundCodec } from './soundTrack';

/** Without sound where this browser encodes none; the same video where there is nothing to add. */
export async function withSpeech(
  video: Blob,
  kind: VideoKind,
  { sound, captions }: Pick<Performance, 'sound' | 'captions'>,
): Promise<Blob> {
  const codec = sound && (await soundCodec(kind, sound));
  if (!codec && captions.length === 0) return video;
  const { ALL_FORMATS, BlobSource, BufferTarget, EncodedPacketSink, EncodedVideoPacketSource, Input, Output } = await import('mediabunny');
  const track = await new Input({ source: new BlobSource(video), formats: ALL_FORMATS }).getPrimaryVideoTrack();
  const videoCodec = await track?.getCodec();
  if (!track || !videoCodec) throw new Error('The video of the server cannot be read.');
  const target = new BufferTarget();
  const output = new Output({ format: await fileFormat(kind), target });
  const pictures = new EncodedVideoPacketSource(videoCodec);
  output.addVideoTrack(pictures);
  const speak = sound && codec ? await addSound(output, codec, sound) : () => Promise.resolve();
  const caption = await addCaptions(output, captions);
  await output.start();
  await caption();
  const decoderConfig = (await track.getDecoderConfig()) ?? undefined;
  let end = 0;
  for await (const packet of new EncodedPacketSink(track).packets()) {
    await pictures.add(packet, { decoderConfig });
    end = Math.max(end, packet.timestamp + packet.duration);
    await speak(end);
  }
  await output.finalize();
  if (!target.buffer) throw new Error('The encoder gave no file.');
  return new Blob([target.buffer], { type: MEDIA_TYPES[kind] });
}
