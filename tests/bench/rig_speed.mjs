// CPU milliseconds of the rig in WASM: build, and a mouth pose with path strings. Usage: node tests/bench/rig_speed.mjs
import { readFileSync } from 'node:fs';
import { channelNames, fitPins, initSync, Rig } from '../../web/src/rig/wasm/vectortalker_browser.js';

const WASM = new URL('../../web/src/rig/wasm/vectortalker_browser_bg.wasm', import.meta.url);
const SIDE = 512;
const SEGMENTS = 8;
const PATHS = [500, 1000];
const PINS = [195, 210, 315, 210, 255, 280, 210, 335, 302, 335];
const ROUNDS = 15;

/** Numbers in [0, 1), the same every run (Park and Miller). */
function generator(seed) {
  let state = seed;
  return () => {
    state = (state * 48271) % 2147483647;
    return state / 2147483647;
  };
}

/** Wobbly closed chains, most of them small and on the face, as a vectorised portrait has them. */
function blobs(count) {
  const random = generator(7);
  const points = [];
  for (let path = 0; path < count; path++) {
    const radius = 6 + 80 * random() ** 3;
    const [x, y] = [SIDE * (0.2 + 0.6 * random()), SIDE * (0.15 + 0.7 * random())];
    for (let i = 0; i < 3 * SEGMENTS; i++) {
      const angle = (2 * Math.PI * i) / (3 * SEGMENTS);
      const r = radius * (0.8 + 0.4 * random());
      points.push(x + r * Math.cos(angle), y + r * Math.sin(angle));
    }
  }
  return Float64Array.from(points);
}

/** Median CPU ms of `work`. */
function cpuMs(work) {
  const times = Array.from({ length: ROUNDS }, () => {
    const start = process.cpuUsage();
    work();
    const { user, system } = process.cpuUsage(start);
    return (user + system) / 1000;
  });
  return times.sort((a, b) => a - b)[ROUNDS >> 1];
}

initSync({ module: readFileSync(WASM) });
const face = fitPins(Float64Array.from(PINS));
const open = Float64Array.from(channelNames(), (name) => ({ jaw: 0.6, width: 0.3, upper_raise: 0.3 })[name] ?? 0);
const none = new Float64Array();

for (const count of PATHS) {
  const points = blobs(count);
  const segments = new Uint32Array(count).fill(SEGMENTS);
  const layers = new Uint8Array(count).fill(1);
  const build = () => new Rig(SIDE, SIDE, points, segments, layers, face.subarray(0, 136), face.subarray(136), none, true, true);
  const rig = build();
  const buildMs = cpuMs(() => build().free());
  const rest = rig.restVertices;
  const axes = new Float64Array(4 * count);
  const frameOf = () => {
    const posed = rig.vertices(open, none);
    const frame = rig.frameData(posed.positions, rest, axes);
    const counts = { changed: frame.changed.length, characters: frame.text.length };
    for (const object of [posed, frame]) object.free();
    return counts;
  };
  const frameMs = cpuMs(() => {
    for (let i = 0; i < 10; i++) frameOf();
  });
  const pieces = Array.from({ length: count }, (_, path) => rig.restPath(path).length / 6).reduce((a, b) => a + b);
  const { changed, characters } = frameOf();
  console.log(
    `${count} paths, ${count * SEGMENTS} cubics → ${pieces} pieces: build ${buildMs.toFixed(1)} ms; ` +
      `mouth pose with strings ${(frameMs / 10).toFixed(2)} ms (${changed} paths, ${Math.round(characters / 1024)} kB)`,
  );
}
