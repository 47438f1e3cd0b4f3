/** Follows a job: whole snapshots over server-sent events, with the state of the connection. */
import { cancelJob, jobEventsUrl, RequestError } from './client';
import type { JobState } from './schema';

export type Connection = 'live' | 'reconnecting' | 'lost';

export type JobListener = {
  readonly onState: (state: JobState) => void;
  readonly onConnection: (connection: Connection) => void;
};

const RETRY_MILLISECONDS = 3000;

/** Follows until the job has ended or the returned function is called. The browser resumes dropped streams by itself. */
export function followJob(jobId: string, { onState, onConnection }: JobListener): () => void {
  let source: EventSource;
  let retry: ReturnType<typeof setTimeout> | undefined;

  function open(): void {
    source = new EventSource(jobEventsUrl(jobId));
    source.onopen = () => onConnection('live');
    source.onerror = () => {
      if (source.readyState === EventSource.CONNECTING) onConnection('reconnecting');
      else {
        onConnection('lost');
        retry = setTimeout(open, RETRY_MILLISECONDS);
      }
    };
    source.onmessage = ({ data }: MessageEvent<string>) => {
      const state = JSON.parse(data) as JobState;
      if (hasEnded(state)) close();
      onState(state);
    };
  }

  function close(): void {
    clearTimeout(retry);
    source.close();
  }

  open();
  return close;
}

/** Resolves when the job is done, rejects with the reason why it is not. Aborting cancels it on the server too. */
export function jobDone(jobId: string, signal: AbortSignal, onState: (state: JobState) => void): Promise<void> {
  return new Promise((resolve, reject) => {
    const unfollow = followJob(jobId, {
      onState: (state) => {
        onState(state);
        if (!hasEnded(state)) return;
        if (state.phase === 'done') resolve();
        else reject(new RequestError(state.error?.code ?? 'internal', state.error?.message ?? 'The server stopped the work.'));
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

export function hasEnded(state: JobState): boolean {
  return state.phase === 'done' || state.phase === 'failed' || state.phase === 'cancelled';
}
