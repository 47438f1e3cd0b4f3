/** Asks the server; every failure becomes a `RequestError` with the server's code and sentence. */
import { unlessLeaving } from './leaving';
import type { Faces, JobRequest, JobState, Landmarks, Portrait, Scene, VectorizeOptions, VideoRequest } from './schema';

/** The server's own codes, and `offline` when it does not answer at all. */
export class RequestError extends Error {
  readonly code: string;

  constructor(code: string, message: string) {
    super(message);
    this.name = 'RequestError';
    this.code = code;
  }
}

/** Options of a job that nobody has changed; null: what the preset says. */
export const STANDARD_OPTIONS: VectorizeOptions = {
  preset: 'standard',
  recipe: 'best',
  segments: 8,
  seed: 0,
  opacity: 'free',
  layers: true,
};

export function postPortrait(picture: Blob, name: string, signal?: AbortSignal): Promise<Portrait> {
  const body = new FormData();
  body.append('file', picture, name);
  return request('api/portraits', { method: 'POST', body, signal });
}

/** Everything made from the portrait goes with it, for good. */
export async function deletePortrait(portraitId: string): Promise<void> {
  await answered(`api/portraits/${encodeURIComponent(portraitId)}`, { method: 'DELETE' });
}

export function portraitImageUrl(portraitId: string): string {
  return `api/portraits/${encodeURIComponent(portraitId)}/image`;
}

export async function getPortraitImage(portraitId: string, signal?: AbortSignal): Promise<Blob> {
  return requestBlob(portraitImageUrl(portraitId), { signal });
}

export function getFaces(portraitId: string, signal?: AbortSignal): Promise<Faces> {
  return request(`api/portraits/${encodeURIComponent(portraitId)}/faces`, { signal });
}

export function postJob(portraitId: string, landmarks: Landmarks | null, options: VectorizeOptions): Promise<JobState> {
  const body: JobRequest = { portrait_id: portraitId, landmarks, find_face: false, options };
  return request('api/jobs', { method: 'POST', body: JSON.stringify(body), headers: { 'content-type': 'application/json' } });
}

export function getJob(jobId: string, signal?: AbortSignal): Promise<JobState> {
  return request(jobUrl(jobId), { signal });
}

export function getScene(jobId: string): Promise<Scene> {
  return request(`${jobUrl(jobId)}/scene`, {});
}

export function jobEventsUrl(jobId: string): string {
  return `${jobUrl(jobId)}/events`;
}

/** Keeps what is there: the job ends after its current step with the scene it has. */
export async function finishJob(jobId: string): Promise<void> {
  await answered(`${jobUrl(jobId)}/finish`, { method: 'POST' });
}

export async function cancelJob(jobId: string): Promise<void> {
  await answered(jobUrl(jobId), { method: 'DELETE' });
}

export function postVideo(video: VideoRequest, signal?: AbortSignal): Promise<JobState> {
  return request('api/videos', { method: 'POST', body: JSON.stringify(video), headers: { 'content-type': 'application/json' }, signal });
}

export async function getVideo(jobId: string, signal?: AbortSignal): Promise<Blob> {
  return requestBlob(`api/videos/${encodeURIComponent(jobId)}/file`, { signal });
}

const jobUrl = (jobId: string) => `api/jobs/${encodeURIComponent(jobId)}`;

/** The JSON that the server answers. */
export async function request<T>(url: string, init: RequestInit): Promise<T> {
  const response = await answered(url, init);
  return (await unlessLeaving(response.json())) as T;
}

/** The file that the server answers. */
export async function requestBlob(url: string, init: RequestInit): Promise<Blob> {
  const response = await answered(url, init);
  return unlessLeaving(response.blob());
}

/** The answer itself, if it is no refusal. */
export async function answered(url: string, init: RequestInit): Promise<Response> {
  const response = await unlessLeaving(fetch(url, init)).catch((reason: unknown) => {
    if (reason instanceof DOMException && reason.name === 'AbortError') throw reason;
    throw new RequestError('offline', 'The server does not answer. What is open here stays and can be edited, played and exported.');
  });
  if (!response.ok) throw await refusal(response);
  return response;
}

async function refusal(response: Response): Promise<RequestError> {
  const body: unknown = await response.json().catch(() => null);
  if (isApiError(body)) return new RequestError(body.code, body.message);
  const offline = response.status === 502 || response.status === 503 || response.status === 504;
  return new RequestError(offline ? 'offline' : 'internal', `The server answered with status ${response.status}.`);
}

function isApiError(body: unknown): body is { code: string; message: string } {
  return typeof body === 'object' && body !== null && 'code' in body && 'message' in body && typeof body.message === 'string';
}
