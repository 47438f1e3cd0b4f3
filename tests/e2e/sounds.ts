/** Sounds made from numbers: syllables like "ba" between silences, as a WAV file. */

const RATE = 16_000;
const PITCHES = [150, 105] as const; // Hz at the beginning and the end of a syllable: a voice is never still
/** Formants of b and of an open a: frequencies in Hz, bandwidth, level. */
const FORMANTS = [
  [300, 730, 90, 1],
  [900, 1090, 110, 0.6],
  [2300, 2440, 160, 0.3],
] as const;
const GLIDE_SECONDS = 0.05; // from the one to the other
const RAMP_SECONDS = 0.02;

/** [start, end] of the syllables in seconds. */
export const SYLLABLES: readonly (readonly [number, number])[] = [
  [0.4, 0.62],
  [0.95, 1.13],
  [1.5, 1.75],
  [1.85, 2.02],
  [2.4, 2.62],
];
export const SOUND_SECONDS = 3;

export function syllablesWav(): Buffer {
  const samples = Float64Array.from({ length: SOUND_SECONDS * RATE }, (_, k) => 0.5 * voice(k / RATE));
  const header = Buffer.alloc(44);
  header.write('RIFF', 0, 'latin1');
  header.writeUInt32LE(36 + 2 * samples.length, 4);
  header.write('WAVEfmt ', 8, 'latin1');
  header.writeUInt32LE(16, 16);
  header.writeUInt16LE(1, 20); // PCM
  header.writeUInt16LE(1, 22); // mono
  header.writeUInt32LE(RATE, 24);
  header.writeUInt32LE(2 * RATE, 28);
  header.writeUInt16LE(2, 32);
  header.writeUInt16LE(16, 34);
  header.write('data', 36, 'latin1');
  header.writeUInt32LE(2 * samples.length, 40);
  return Buffer.concat([
    header,
    Buffer.from(Int16Array.from(samples, (value) => Math.round(32_000 * Math.max(-1, Math.min(1, value)))).buffer),
  ]);
}

function voice(time: number): number {
  const syllable = SYLLABLES.find(([start, end]) => time >= start && time < end);
  if (!syllable) return 0;
  const [start, end] = syllable;
  const loudness = Math.min(1, (time - start) / RAMP_SECONDS, (end - time) / RAMP_SECONDS);
  return loudness * vowel(time - start, (time - start) / (end - start));
}

/** Harmonics of a falling pitch, weighted by the resonances; `share` of the syllable has passed. */
function vowel(time: number, share: number): number {
  const [high, low] = PITCHES;
  const pitch = high + (low - high) * share;
  const cycles = time * (high + ((low - high) * share) / 2); // the integral of the pitch
  const glide = Math.min(1, time / GLIDE_SECONDS);
  let sum = 0;
  for (let harmonic = 1; harmonic * pitch < 4000; harmonic += 1) {
    const gain = FORMANTS.reduce((most, [from, to, width, level]) => {
      const centre = from + (to - from) * glide;
      return most + level / (1 + ((harmonic * pitch - centre) / width) ** 2);
    }, 0);
    sum += gain * Math.sin(2 * Math.PI * harmonic * cycles);
  }
  return sum / 2;
}
