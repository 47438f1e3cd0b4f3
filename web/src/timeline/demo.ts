/** The built-in demo: the face blinks, smiles, speaks and tilts its head, and comes back to rest. */
import type { Track } from '../api/schema';

const FPS = 25;

/** [time in seconds, value]; eased between the keys. */
type Key = readonly [number, number];

const BLINK_TIMES = [0.5, 3.1, 6.4, 6.75]; // the last two make a double blink
const CLOSE_SECONDS = 0.08;
const SHUT_SECONDS = 0.06;
const OPEN_SECONDS = 0.16;

/** Jaw, width, round, upper lip and press at syllables of "hello, here I am". */
const SYLLABLES: readonly {
  readonly time: number;
  readonly jaw: number;
  readonly width: number;
  readonly round: number;
  readonly press: number;
}[] = [
  { time: 3.5, jaw: 0.35, width: 0.3, round: 0, press: 0 },
  { time: 3.68, jaw: 0.15, width: 0.1, round: 0, press: 0 },
  { time: 3.9, jaw: 0.5, width: -0.4, round: 0.7, press: 0 },
  { time: 4.2, jaw: 0.05, width: 0, round: 0.1, press: 0 },
  { time: 4.45, jaw: 0.35, width: 0.6, round: 0, press: 0 },
  { time: 4.65, jaw: 0.2, width: -0.1, round: 0.3, press: 0 },
  { time: 4.9, jaw: 0.75, width: 0.2, round: 0, press: 0 },
  { time: 5.1, jaw: 0.3, width: 0.6, round: 0, press: 0 },
  { time: 5.35, jaw: 0.65, width: 0.3, round: 0, press: 0 },
  { time: 5.6, jaw: 0, width: 0, round: 0.1, press: 0.9 },
  { time: 5.8, jaw: 0, width: 0, round: 0, press: 0 },
];

const SPEECH_START: Key = [3.3, 0];
const syllableKeys = (channel: 'jaw' | 'width' | 'round' | 'press'): Key[] => [
  SPEECH_START,
  ...SYLLABLES.map((syllable): Key => [syllable.time, syllable[channel]]),
];

const CHANNEL_KEYS: Readonly<Record<string, readonly Key[]>> = {
  smile: [
    [0.9, 0],
    [1.4, 0.75],
    [2.3, 0.75],
    [3, 0.15],
    [6, 0.2],
    [7.4, 0],
  ],
  jaw: syllableKeys('jaw'),
  width: syllableKeys('width'),
  round: syllableKeys('round'),
  press: syllableKeys('press'),
  brow_left: [
    [1, 0],
    [1.4, 0.3],
    [2.3, 0.1],
    [3.4, 0],
    [3.9, 0.45],
    [4.4, 0.1],
    [5, 0.35],
    [5.8, 0],
  ],
  brow_right: [
    [1, 0],
    [1.4, 0.3],
    [2.3, 0.1],
    [3.4, 0],
    [3.9, 0.4],
    [4.4, 0.1],
    [5, 0.3],
    [5.8, 0],
  ],
  gaze_x: [
    [2.2, 0],
    [2.35, 0.35],
    [2.9, 0.35],
    [3.05, 0],
  ],
  roll: [
    [5.8, 0],
    [6.4, 7],
    [6.9, 7],
    [7.6, 0],
  ],
  yaw: [
    [0, 0],
    [1.6, 3],
    [3.2, -3],
    [4.6, 4],
    [6, -2],
    [7.6, 0],
  ],
  pitch: [
    [3.4, 0],
    [3.9, 2.5],
    [4.4, -1],
    [5, 3],
    [5.7, 0],
  ],
};

export function demoTrack(): Track {
  const duration = 8;
  const count = duration * FPS;
  const sampled = (keys: readonly Key[]) => Array.from({ length: count }, (_, frame) => rounded(valueAt(keys, frame / FPS)));
  const blink = sampled(BLINK_TIMES.flatMap(blinkKeys));
  const channels = Object.entries(CHANNEL_KEYS).map(([name, keys]) => [name, sampled(keys)] as const);
  return {
    schema_version: 1,
    name: 'Blink, smile, speak, tilt',
    duration,
    fps: FPS,
    articulators: { blink_left: blink, blink_right: blink, ...Object.fromEntries(channels) },
  };
}

function blinkKeys(start: number): Key[] {
  const shut = start + CLOSE_SECONDS;
  return [
    [start, 0],
    [shut, 1],
    [shut + SHUT_SECONDS, 1],
    [shut + SHUT_SECONDS + OPEN_SECONDS, 0],
  ];
}

/** Between two keys along a cosine; held before the first and after the last. */
function valueAt(keys: readonly Key[], time: number): number {
  const next = keys.findIndex(([at]) => at > time);
  if (next === 0) return keys[0][1];
  if (next < 0) return keys[keys.length - 1][1];
  const [from, a] = keys[next - 1];
  const [to, b] = keys[next];
  return a + ((b - a) * (1 - Math.cos((Math.PI * (time - from)) / (to - from)))) / 2;
}

const rounded = (value: number) => Math.round(value * 1000) / 1000;
