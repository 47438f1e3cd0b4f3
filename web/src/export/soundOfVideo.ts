/** Adds sound to a video that was made elsewhere, its pictures as they are. */

import { fileFormat, MEDIA_TYPES, type VideoKind } from './container';
import { addSound, soundCodec } from './soundTrack';

/** The same video where this browser encodes no sound. */
export async function withSound(video: Blob, kind: VideoKind, sound: AudioBuffer): Promise<Blob> {
  const codec = await soundCodec(kind, sound);
  if (!codec) return video;
  const { ALL_FORMATS, BlobSource, BufferTarget, EncodedPacketSink, EncodedVideoPacketSource, Input, Output } = await import('mediabunny');
  const track = await new Input({ source: new BlobSource(video), formats: ALL_FORMATS }).getPrimaryVideoTrack();
  const videoCodec = await track?.getCodec();
  if (!track || !videoCodec) throw new Error('The video of the server cannot be read.');
  const target = new BufferTarget();
  const output = new Output({ format: await fileFormat(kind), target });
  const pictures = new EncodedVideoPacketSource(videoCodec);
  output.addVideoTrack(pictures);
  const speak = await addSound(output, codec, sound);
  await output.start();
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
