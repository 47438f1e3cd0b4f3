import { describe, expect, test } from 'vitest';
import type { Block } from './blocks';
import { captionsOf, cueAt, webVtt } from './captions';
import { type SpeechTrack, STANDARD_CHOICES } from './speechTrack';

/** A track that says `transcript` with its lips moving in `spans`. */
function saying(transcript: string, spans: readonly (readonly [number, number])[] | null, duration: number): SpeechTrack {
  const blocks = spans?.map(([start, end]): Block => ({ t: start, d: end - start, viseme: 'aa', weight: 1 }));
  return {
    schema_version: 1,
    name: 'Speech',
    duration,
    fps: 50,
    articulators: {},
    visemes: blocks && [...blocks],
    choices: { ...STANDARD_CHOICES, transcript },
  };
}

describe('captionsOf', () => {
  test('a sentence is shown while it is said, and a little longer', () => {
    expect(captionsOf(saying('Good morning.', [[0.5, 1.5]], 4))).toEqual([{ start: 0.5, end: 2.3, text: 'Good morning.' }]);
  });

  test('a sentence ends at the pause near where its letters end', () => {
    const spans = [
      [0, 1], // 9 of 20 letters are 0.99 s of the 2.2 s of speech
      [2, 3.2],
    ] as const;
    expect(captionsOf(saying('Who are you? I am a drawing.', spans, 3.2))).toEqual([
      { start: 0, end: 1.8, text: 'Who are you?' },
      { start: 2, end: 3.2, text: 'I am a drawing.' },
    ]);
  });

  test('without a pause, time is shared by letters', () => {
    const cues = captionsOf(saying('Abc. Abcdefghi.', [[1, 5]], 5)); // 3 and 9 of 12 letters
    expect(cues.map(({ start, end }) => [start, end])).toEqual([
      [1, 2],
      [2, 5],
    ]);
  });

  test('closures within words are no pauses', () => {
    const spans = [
      [0, 1],
      [1.1, 2],
    ] as const;
    expect(captionsOf(saying('One line.', spans, 2))).toEqual([{ start: 0, end: 2, text: 'One line.' }]);
  });

  test('a long sentence becomes pieces of whole words, about as long as each other', () => {
    const sentence = `${Array.from({ length: 30 }, (_, k) => `word${k}`).join(' ')}.`;
    const texts = captionsOf(saying(sentence, null, 10)).map(({ text }) => text);
    expect(texts.join(' ')).toBe(sentence);
    expect(texts).toHaveLength(3); // 199 characters
    for (const text of texts) expect(Math.abs(text.length - 66)).toBeLessThan(8);
  });

  test('a long sentence is parted at a comma where one is near its middle', () => {
    const sentence = 'I am a portrait, drawn again in a few hundred curves, and I can say whatever you like.';
    expect(captionsOf(saying(sentence, null, 6)).map(({ text }) => text)).toEqual([
      'I am a portrait, drawn again in a few hundred curves,',
      'and I can say whatever you like.',
    ]);
  });

  test('cues follow each other and never overlap, however the pauses lie', () => {
    const spans = Array.from({ length: 12 }, (_, k) => [k, k + 0.3 + 0.1 * (k % 4)] as const);
    const cues = captionsOf(saying('A. Be. See. Dee! Eee? Eff. Gee. Aitch. Eye, eye, eye. Jay.', spans, 12));
    expect(cues).toHaveLength(10);
    for (const [k, { start, end }] of cues.entries()) {
      expect(end).toBeGreaterThan(start);
      if (k > 0) expect(start).toBeGreaterThanOrEqual(cues[k - 1].end);
    }
  });

  test('languages without spaces are parted, too', () => {
    const track = saying('今日は天気がいいです。散歩に行きましょう。', [[0, 3]], 3);
    expect(captionsOf(track).map(({ text }) => text)).toEqual(['今日は天気がいいです。', '散歩に行きましょう。']);
  });

  test('no words, no lips, no track: no cues', () => {
    expect(captionsOf(saying('  ', [[0, 1]], 1))).toEqual([]);
    expect(captionsOf(saying('Words.', [], 1))).toEqual([]);
    expect(captionsOf(null)).toEqual([]);
  });
});

test('a cue is found by its time, its end belongs to the next', () => {
  const cues = [
    { start: 0, end: 1, text: 'one' },
    { start: 1, end: 2, text: 'two' },
  ];
  expect([0, 0.99, 1, 2].map((time) => cueAt(cues, time)?.text)).toEqual(['one', 'one', 'two', undefined]);
});

test('WebVTT has a header, times to the millisecond, and no markup in the words', () => {
  expect(webVtt([{ start: 0.4, end: 3661.0005, text: 'a < b & c' }])).toBe('WEBVTT\n\n00:00:00.400 --> 01:01:01.001\na &lt; b &amp; c\n');
});
