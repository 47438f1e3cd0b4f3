/** Has the server render a video, for browsers that cannot encode one: POST, follow its job, fetch the file. */
import { cancelJob, getVideo, postVideo } from '../api/client';
import { followJob, hasEnded } from '../api/events';
import { bakedTrack, type Performance } from './motion';
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
  await finished(job.id, signal, onProgress);
  return getVideo(job.id, signal);
}

function finished(jobId: string, signal: AbortSignal, onProgress: (share: number) => void): Promise<void> {
  return new Promise((resolve, reject) => {
    const unfollow = followJob(jobId, {
      onState: (state) => {
        onProgress(state.progress);
        if (!hasEnded(state)) return;
        if (state.phase === 'done') resolve();
        else reject(new Error(state.error?.message ?? 'The server stopped rendering.'));
      },
      onConnection: () => {},
    });
    signal.addEventListener('abort', () => {
      unfollow();
      cancelJob(jobId).catch(() => {}); // the person has left; the server ends the job by itself when it cannot be told
      reject(signal.reason);
    });
  });
}
