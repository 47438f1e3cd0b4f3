/** Actions on the sounds of the project. */
import type { Edit } from '../store/edit';
import { type Clip, clips, history } from '../store/state';
import { audioOf } from './speechTrack';

const ENDINGS: Readonly<Record<string, string>> = {
  'audio/mpeg': 'mp3',
  'audio/ogg': 'ogg',
  'audio/flac': 'flac',
  'audio/mp4': 'm4a',
  'audio/x-m4a': 'm4a',
  'audio/webm': 'webm',
  'video/webm': 'webm',
};

/** Puts a sound among the clips, under a plain file name of its own; those that no step of the history names are dropped. */
export function keepClip(data: Blob, label: string, id: string | null): Clip {
  const known = clips.value.find((clip) => clip.data === data);
  if (known) return known;
  const taken = namesInUse();
  const kept = clips.value.filter(({ name }) => taken.has(name));
  const clip = { id, name: freeName(label, data.type, taken), data };
  clips.value = [...kept, clip];
  return clip;
}

/** The server has been given the clip and calls it `id`. */
export function nameClip(clip: Clip, id: string): void {
  clips.value = clips.value.map((kept) => (kept.name === clip.name ? { ...kept, id } : kept));
}

/** What a clip holds, by its ending; recordings of the editor are sound only. */
export function mediaTypeOf(name: string): string {
  const ending = name.slice(name.lastIndexOf('.') + 1);
  return Object.keys(ENDINGS).find((type) => ENDINGS[type] === ending) ?? `audio/${ending}`;
}

/** The clips that tracks of `edit` speak with, in the order of the tracks. */
export function clipsOf(edit: Edit): Clip[] {
  const named = new Set(edit.tracks.map(audioOf));
  return [...named].flatMap((name) => clips.value.find((clip) => clip.name === name) ?? []);
}

function namesInUse(): ReadonlySet<string | null> {
  const { past, present, future } = history.value;
  return new Set([...past, present, ...future].flatMap(({ tracks }) => tracks.map(audioOf)));
}

/** `speech-hello.wav`, `speech-hello-2.wav`, …: letters, digits and dashes, whatever the file was called. */
export function freeName(label: string, type: string, taken: ReadonlySet<string | null>): string {
  const [, base, given] = /^(.*?)(?:\.(\w{1,5}))?$/s.exec(label) ?? [];
  const plain = (base ?? '').replace(/[^A-Za-z0-9]+/g, '-').replace(/^-+|-+$/g, '');
  const ending = ENDINGS[type.split(';')[0]] ?? given?.toLowerCase() ?? 'wav';
  const numbered = (number: number) => `speech${plain && `-${plain.slice(0, 40)}`}${number > 1 ? `-${number}` : ''}.${ending}`;
  let number = 1;
  while (taken.has(numbered(number))) number += 1;
  return numbered(number);
}
