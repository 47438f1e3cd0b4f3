/** Has the server render a video, for browsers that cannot encode one: POST, follow its job, fetch the file, add sound and captions. */
import { getVideo, postVideo } from '../api/client';
import { jobDone } from '../api/events';
import { bakedTrack, type Performance } from './motion';
import { withSpeech } from './speechOfVideo';
import type { VideoOptions } from './videoFile';

/** The finished file. Aborting cancels the job on the server too. */
export async function renderOnServer(
  performance: Performance,
  { kind, fps, longerSide }: VideoOptions,
  signal: AbortSignal,
  onProgress: (share: number) => void,
): Promise<Blob> {
  const { scene, landmarks } = performance;
  const job = await postVideo({ scene, landmarks, track: bakedTrack(performance), fps, size: longerSide, format: kind }, signal);
  await jobDone(job.id, signal, ({ progress }) => onProgress(progress));
  const video = await getVideo(job.id, signal);
  return withSpeech(video, kind, performance);
}
