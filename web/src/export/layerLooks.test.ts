import { expect, test } from 'vitest';
import type { Scene } from '../api/schema';
import { areOpaque, type LayerLooks, shownScene, withOpacities } from './layerLooks';

const SHOWN = { visible: true, opacity: 1 };
const LOOKS: LayerLooks = { back: { visible: false, opacity: 0.5 }, fore: { visible: true, opacity: 0.25 }, local: SHOWN };

test('hidden layers lose their paths, the others keep them', () => {
  const path: Scene['back'][number] = { points: [], fill: { kind: 'solid', colour: '#000000', opacity: 1 } };
  const scene: Scene = { width: 1, height: 1, canvas: '#000000', back: [path], fore: [path, path], local: [] };
  const { back, fore } = shownScene(scene, LOOKS);
  expect([back.length, fore.length]).toEqual([0, 2]);
});

test('opacity goes to the group of its layer, before what stands there', () => {
  const svg = '<svg><g id="back" a="1"></g><g id="fore"></g><g id="local"></g></svg>';
  expect(withOpacities(svg, LOOKS)).toBe(
    '<svg><g id="back" opacity="0.5" a="1"></g><g id="fore" opacity="0.25"></g><g id="local"></g></svg>',
  );
});

test('a hidden layer is not seen through', () => {
  expect(areOpaque({ ...LOOKS, fore: SHOWN })).toBe(true);
  expect(areOpaque(LOOKS)).toBe(false);
});
