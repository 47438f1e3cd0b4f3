/** Asks the server about speech: recordings, listening to them, tracks from visemes, and track files of other programs. */
import { answered, request, requestBlob } from './client';
import type {
  JobState,
  Recording,
  SpeechOptions,
  SpeechRequest,
  SpeechResult,
  SpokenRequest,
  Track,
  TrackExportRequest,
  VisemeBlock,
  VisemeTrackRequest,
} from './schema';

export type TrackFormat = TrackExportRequest['format'];

export function postRecording(sound: Blob, name: string, signal?: AbortSignal): Promise<Recording> {
  return request('api/recordings', { method: 'POST', body: formOf(sound, name), signal });
}

/** A text spoken by espeak-ng. */
export function postSpoken(text: string, language: string, signal?: AbortSignal): Promise<Recording> {
  const body: SpokenRequest = { text, language, voice: '', rate: 160, pitch: 50 };
  return request('api/recordings/spoken', { ...posted(body), signal });
}

export async function getRecordingAudio(recordingId: string, signal?: AbortSignal): Promise<Blob> {
  return requestBlob(`api/recordings/${encodeURIComponent(recordingId)}/audio`, { signal });
}

export async function deleteRecording(recordingId: string): Promise<void> {
  await answered(`api/recordings/${encodeURIComponent(recordingId)}`, { method: 'DELETE' });
}

export function postSpeech(speech: SpeechRequest, signal?: AbortSignal): Promise<JobState> {
  return request('api/speech', { ...posted(speech), signal });
}

export function getSpeechResult(jobId: string, signal?: AbortSignal): Promise<SpeechResult> {
  return request(`api/speech/${encodeURIComponent(jobId)}/result`, { signal });
}

/** The track of edited blocks; takes milliseconds. */
export function postVisemes(
  visemes: readonly VisemeBlock[],
  duration: number,
  loudness: readonly number[] | null,
  options: SpeechOptions,
  signal?: AbortSignal,
): Promise<Track> {
  const body: VisemeTrackRequest = {
    visemes: [...visemes],
    duration,
    loudness: loudness ? [...loudness] : null,
    options,
    name: 'speech',
    as: 'articulators',
  };
  return request('api/tracks/visemes', { ...posted(body), signal });
}

export function importTrack(file: Blob, name: string, signal?: AbortSignal): Promise<Track> {
  return request('api/tracks/import', { method: 'POST', body: formOf(file, name), signal });
}

export async function exportTrack(track: Track, format: TrackFormat, signal?: AbortSignal): Promise<Blob> {
  const body: TrackExportRequest = { track, format };
  return requestBlob('api/tracks/export', { ...posted(body), signal });
}

function formOf(file: Blob, name: string): FormData {
  const form = new FormData();
  form.append('file', file, name);
  return form;
}

const posted = (body: object): RequestInit => ({
  method: 'POST',
  body: JSON.stringify(body),
  headers: { 'content-type': 'application/json' },
});
