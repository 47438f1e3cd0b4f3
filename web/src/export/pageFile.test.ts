/** The pages of the command line are the golden ones: the same parts give the same bytes here. */
import { readFileSync } from 'node:fs';
import { expect, test } from 'vitest';
import { pageText, playerOf } from './pageFile';

const golden = (name: string) => readFileSync(new URL(`../../../tests/vectors/page/${name}.html`, import.meta.url), 'utf8');
const SVG = '<svg><title>$player &amp; $1</title></svg>'; // looks like what a template or a replacement fills in
const TITLE = 'Ada & <Lucy> $svg';

test('a silent page', () => expect(pageText(SVG, TITLE, null)).toBe(golden('silent')));

test('a page with sound', () => {
  expect(pageText(SVG, TITLE, playerOf('data:audio/mp4;base64,AAEC', false, null))).toBe(golden('spoken'));
});

test('captions are a track of the sound', () => {
  expect(playerOf('data:audio/mp4;base64,AAEC', true, 'data:text/vtt;base64,V0VCVlRU')).toBe(
    '<audio controls loop src="data:audio/mp4;base64,AAEC">' +
      '<track kind="captions" label="Captions" src="data:text/vtt;base64,V0VCVlRU" default></audio>',
  );
});
