// Writes the sample landmark track: 68 points a frame say "good morning", blink once and sway a little.
// Offsets are in outer-eye distances from a neutral face, y down.
import { mkdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { root } from './run.mjs';

const FPS = 25;
const SECONDS = 3.2;
const N_LANDMARKS = 68;

// [second, jaw, width, closed lids, brows]: g-oo-d m-or-n-i-ng
const KEYS = [
  [0, 0, 0, 0, 0],
  [0.3, 0.15, 0, 0, 0.2],
  [0.48, 0.35, -0.7, 0, 0.4],
  [0.7, 0.12, 0, 0, 0.3],
  [0.95, 0, 0, 0, 0.1],
  [1.15, 0.8, -0.5, 0, 0.3],
  [1.45, 0.2, 0.1, 0, 0.1],
  [1.62, 0.45, 0.8, 0, 0.2],
  [1.9, 0.15, 0.3, 0, 0],
  [2.2, 0, 0.2, 0, 0],
  [2.3, 0, 0.2, 0, 0],
  [2.38, 0, 0.2, 1, -0.1],
  [2.44, 0, 0.2, 1, -0.1],
  [2.6, 0, 0.15, 0, 0],
  [3.2, 0, 0, 0, 0],
];

// Per landmark: [dx, dy] for full jaw, width, lids and brows.
const still = [0, 0];
const BASIS = Array.from({ length: N_LANDMARKS }, () => ({ jaw: still, width: still, lids: still, brows: still }));
const move = (channel, indices, offset) => {
  for (const index of indices) BASIS[index] = { ...BASIS[index], [channel]: offset };
};
move('jaw', [7, 8, 9], [0, 0.2]);
move('jaw', [5, 6, 10, 11], [0, 0.15]);
move('jaw', [3, 4, 12, 13], [0, 0.06]);
move('jaw', [56, 57, 58, 65, 66, 67], [0, 0.2]);
move('jaw', [55, 59], [0, 0.14]);
move('jaw', [48, 60], [0.025, 0.05]);
move('jaw', [54, 64], [-0.025, 0.05]);
move('jaw', [50, 51, 52, 61, 62, 63], [0, -0.012]);
move('width', [48, 60], [-0.05, 0]);
move('width', [54, 64], [0.05, 0]);
move('width', [49, 59], [-0.03, 0]);
move('width', [53, 55], [0.03, 0]);
move('lids', [37, 38, 43, 44], [0, 0.085]);
move('lids', [40, 41, 46, 47], [0, -0.012]);
move('brows', [17, 18, 19, 20, 21, 22, 23, 24, 25, 26], [0, -0.06]);

/** Channels at a second, along a cosine between the keys. */
function channelsAt(second) {
  const next = Math.max(
    1,
    KEYS.findIndex(([at]) => at > second),
  );
  const [from, to] = second >= SECONDS ? [KEYS.at(-1), KEYS.at(-1)] : [KEYS[next - 1], KEYS[next]];
  const share = from === to ? 0 : (1 - Math.cos((Math.PI * (second - from[0])) / (to[0] - from[0]))) / 2;
  const [jaw, width, lids, brows] = from.slice(1).map((value, k) => value + (to[k + 1] - value) * share);
  return { jaw, width, lids, brows };
}

function frameAt(second) {
  const channels = Object.entries(channelsAt(second));
  const fade = Math.sin((Math.PI * second) / SECONDS);
  const sway = [0.018 * Math.sin(2.1 * second) * fade, 0.012 * Math.sin(3.3 * second) * fade];
  return BASIS.map((basis) =>
    [0, 1].map((axis) => rounded(sway[axis] + channels.reduce((sum, [name, value]) => sum + value * basis[name][axis], 0))),
  );
}

const rounded = (value) => Math.round(value * 1e4) / 1e4 + 0; // + 0 turns −0 into 0

const landmarks = Array.from({ length: Math.round(SECONDS * FPS) }, (_, frame) => frameAt(frame / FPS));
const folder = join(root, 'public/tracks');
mkdirSync(folder, { recursive: true });
const track = { schema_version: 1, name: 'Good morning, 68 landmarks', duration: SECONDS, fps: FPS, landmarks };
writeFileSync(join(folder, 'good-morning.json'), `${JSON.stringify(track)}\n`);
writeFileSync(
  join(folder, 'index.json'),
  `${JSON.stringify([{ file: 'good-morning.json', label: 'Sample: good morning, 68 landmarks' }], null, 2)}\n`,
);
