/** The decoded sound of the track on the timeline. */
import { computed, effect, signal } from '@preact/signals';
import { report } from '../store/notices';
import { clips, track } from '../store/state';
import { decodeSound, type Sound } from './decoding';
import { audioOf } from './speechTrack';

/** Null while there is none, and until it is decoded. */
export const sound = signal<Sound | null>(null);

/** The sound file that the track on the timeline speaks with. */
export const clip = computed(() => {
  const name = audioOf(track.value);
  return clips.value.find((candidate) => candidate.name === name) ?? null;
});

/** Sounds that were decoded before they became clips, so that none is decoded twice. */
const decodedSounds = new WeakMap<Blob, Promise<Sound>>();

/** Decodes once a blob. */
export function soundOf(data: Blob, name: string): Promise<Sound> {
  const known = decodedSounds.get(data) ?? decodeSound(data, name);
  decodedSounds.set(data, known);
  return known;
}

/** Keeps `sound` that of the track on the timeline. */
export function followSound(): void {
  const data = computed(() => clip.value?.data ?? null); // the same while only the server's name of the clip changes
  effect(() => {
    const wanted = data.value;
    sound.value = null;
    if (!wanted) return;
    soundOf(wanted, clip.peek()?.name ?? '')
      .then((decoded) => {
        if (data.value === wanted) sound.value = decoded;
      })
      .catch(report);
  });
}
