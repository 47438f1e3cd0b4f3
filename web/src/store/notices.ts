/** The one place where messages to people start: a bar on the stage, and the live region. */
import { RequestError } from '../api/client';
import { announcement, type Notice, notice } from './state';

export function tell(next: Notice): void {
  notice.value = next;
  announce(next.text);
}

export function dismiss(): void {
  notice.value = null;
}

/** Said to screen readers only. */
export function announce(text: string): void {
  announcement.value = text;
}

/** A failure as its own sentence; aborted requests are no failure. */
export function report(error: unknown, action?: Notice['action']): void {
  if (error instanceof DOMException && error.name === 'AbortError') return;
  if (!(error instanceof Error)) throw error;
  if (!(error instanceof RequestError) && !isExpected(error)) console.error(error);
  tell({ kind: 'error', text: error.message, action });
}

/** Faults of a file that a person opened; their messages are written for people. */
export class FileError extends Error {
  constructor(message: string) {
    super(message);
    this.name = 'FileError';
  }
}

const isExpected = (error: Error) => error instanceof FileError;
