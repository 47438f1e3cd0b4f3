/** Follows a job: whole snapshots over server-sent events, with the state of the connection. */
import { jobEventsUrl } from './client';
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

export function hasEnded(state: JobState): boolean {
  return state.phase === 'done' || state.phase === 'failed' || state.phase === 'cancelled';
}
