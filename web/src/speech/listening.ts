/** Actions from a sound to a track: a rough one at once, then what the server hears in it. */
import { getJob, RequestError } from '../api/client';
import { jobDone } from '../api/events';
import type { Span, Track } from '../api/schema';
import { getRecordingAudio, getSpeechResult, postRecording, postSpeech, postSpoken } from '../api/speech';
import { withTrackReplaced } from '../store/edit';
import { amend, apply } from '../store/editing';
import { announce, FileError, report, tell } from '../store/notices';
import { history, track } from '../store/state';
import { useTrack } from '../store/tracks';
import { keepClip, nameClip } from './clips';
import { roughTrack } from './envelope';
import { takeUpChoices } from './retracking';
import { clip, soundOf } from './sound';
import { audioOf, blocksOf, choicesOf, type SpeechTrack, tierOf } from './speechTrack';
import { choices, type Hearing, hearing, keepingChoices, type Listening, listening, pendingBlocks } from './state';

let stopper = new AbortController();

/** A sound file, dropped, picked or recorded, becomes a track that plays at once and gets better. */
export function takeSound(data: Blob, label: string): Promise<void> {
  return attempt({ kind: 'opening', label }, (signal) => speakWith(data, label, signal));
}

/** A text is spoken by the server, and is its own transcript. */
export function speakText(text: string): Promise<void> {
  return attempt({ kind: 'sending' }, async (signal) => {
    const spoken = await postSpoken(text, choices.value.options.language, signal);
    const data = await getRecordingAudio(spoken.id, signal);
    await speakWith(data, titleOf(text), signal, { text, id: spoken.id });
  });
}

/** The sound of the track on the timeline is heard again, with the present choices. */
export function listenAgain(): Promise<void> {
  return attempt({ kind: 'sending' }, async (signal) => {
    if (track.value) await listen(track.value, { transcript: choices.value.transcript }, signal);
  });
}

/** Only `part` is heard again; `words` are what is said in it. */
export function listenToPart(part: Span, words: string): Promise<void> {
  return attempt({ kind: 'sending' }, async (signal) => {
    const visemes = blocksOf(track.value);
    if (track.value && visemes) await listen(track.value, { transcript: words, part, visemes: [...visemes] }, signal);
  });
}

/** Goes on where a reload came before the end: with the server's work on it, else from its beginning. */
export async function resumeHearing(): Promise<void> {
  const asked = hearing.value;
  const base = history.value.present.tracks.find(({ name }) => name === asked?.trackName);
  if (!asked || !base) return rest();
  await attempt({ kind: 'sending' }, async (signal) => {
    const isKnown = asked.jobId !== null && (await isJobKnown(asked.jobId, signal));
    await hear(base, isKnown ? asked : { ...asked, jobId: null }, signal);
  });
}

async function isJobKnown(jobId: string, signal: AbortSignal): Promise<boolean> {
  try {
    return (await getJob(jobId, signal)).phase !== 'cancelled';
  } catch (error) {
    if (error instanceof RequestError && error.code === 'not_found') return false;
    throw error;
  }
}

/** Stops whatever is under way; the rough track stays. */
export function cancelListening(): void {
  stopper.abort();
  rest();
}

/** The words go with the portrait that says them. */
export function leaveSpeech(): void {
  cancelListening();
  choices.value = { ...choices.value, transcript: '' };
}

function rest(): void {
  listening.value = { kind: 'idle' };
  hearing.value = null;
  if (choicesOf(track.value)) takeUpChoices(); // what was chosen meanwhile; tracks of other programs stay as they came
}

async function attempt(first: Listening, work: (signal: AbortSignal) => Promise<void>): Promise<void> {
  stopper.abort();
  stopper = new AbortController();
  const { signal } = stopper;
  listening.value = first;
  try {
    await work(signal);
  } catch (error) {
    if (!signal.aborted) report(error);
  }
  if (!signal.aborted) rest();
}

/** `spoken`: the sound is the server's own, of that text. */
async function speakWith(
  data: Blob,
  label: string,
  signal: AbortSignal,
  spoken?: { readonly text: string; readonly id: string },
): Promise<void> {
  const { mono } = await soundOf(data, label);
  signal.throwIfAborted();
  choices.value = { ...choices.value, transcript: spoken?.text ?? typedTranscript() };
  const { name } = keepClip(data, label, spoken?.id ?? null);
  const rough: SpeechTrack = { ...roughTrack(mono, titleOf(label)), tier: 'rough', audio: name, choices: choices.value };
  useTrack(rough);
  await listen(rough, { transcript: choices.value.transcript }, signal);
}

/** What was typed for the new sound; the words of the track before are not its words. */
function typedTranscript(): string {
  const { transcript } = choices.value;
  return transcript === choicesOf(track.value)?.transcript ? '' : transcript;
}

function listen(base: Track, what: Hearing['what'], signal: AbortSignal): Promise<void> {
  return hear(base, { trackName: base.name, what, choices: choices.value, jobId: null }, signal);
}

async function hear(base: Track, asked: Hearing, signal: AbortSignal): Promise<void> {
  hearing.value = asked;
  const jobId = asked.jobId ?? (await sent(asked, signal));
  signal.throwIfAborted();
  hearing.value = { ...asked, jobId };
  await jobDone(jobId, signal, ({ phase, stage, progress }) => {
    if (!signal.aborted) listening.value = { kind: 'listening', stage: phase === 'queued' ? 'waiting' : stage, progress };
  });
  const { track: heard, visemes, loudness, tier } = await getSpeechResult(jobId, signal);
  const { name } = base;
  if (pendingBlocks.value || !history.value.present.tracks.includes(base)) return tell({ kind: 'advice', text: overtaken(name) });
  keepingChoices(() => place(base, { ...heard, name, visemes, loudness, tier, audio: audioOf(base) ?? undefined, choices: asked.choices }));
  announce(`The lips follow ${name}`);
}

const overtaken = (name: string) => `${name} was edited while it was being listened to: the edit stays, what was heard is dropped.`;

/** The server's name of the job. */
async function sent({ what, choices: { options } }: Hearing, signal: AbortSignal): Promise<string> {
  const request = { ...what, transcript: what.transcript.trim() || null, options };
  return (await withRecording(signal, (recording_id) => postSpeech({ recording_id, ...request }, signal))).id;
}

/** A better track takes the place of the rough one without a step of its own; any other change is one. */
function place(base: Track, heard: SpeechTrack): void {
  const change = tierOf(base) === 'rough' ? amend : apply;
  change((present) => withTrackReplaced(present, base, heard));
}

/** Gives `use` the server's name of the sound; it is sent anew if the server has dropped it. */
async function withRecording<T>(signal: AbortSignal, use: (recordingId: string) => Promise<T>): Promise<T> {
  const spoken = clip.value;
  if (!spoken) throw new FileError('This track has no sound to listen to: choose a sound file.');
  if (spoken.id) {
    try {
      return await use(spoken.id);
    } catch (error) {
      if (!(error instanceof RequestError && error.code === 'not_found')) throw error;
    }
  }
  const { id } = await postRecording(spoken.data, spoken.name, signal);
  nameClip(spoken, id);
  return use(id);
}

const MAX_TITLE = 40;

/** A file name without its ending, or the first words of a text. */
function titleOf(label: string): string {
  const title = label.replace(/\.\w{1,5}$/, '').trim();
  return title.length > MAX_TITLE ? `${title.slice(0, MAX_TITLE - 1).trimEnd()}…` : title || 'Speech';
}
