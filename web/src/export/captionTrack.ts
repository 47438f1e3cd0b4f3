/** Puts captions into a video file, as a track that players offer. */
import type { Output } from 'mediabunny';
import { type Cue, webVtt } from '../speech/captions';

/** Adds the track to an output that has not started, if there are captions. The result writes them all, once it has started. */
export async function addCaptions(output: Output, captions: readonly Cue[]): Promise<() => Promise<void>> {
  if (captions.length === 0) return () => Promise.resolve();
  const { TextSubtitleSource } = await import('mediabunny');
  const source = new TextSubtitleSource('webvtt');
  output.addSubtitleTrack(source, { name: 'Captions' });
  return async () => {
    await source.add(webVtt(captions));
    source.close();
  };
}
