import { describe, expect, it } from 'vitest';
import { freeName } from './clips';

describe('the file name of a clip', () => {
  it.each([
    ['Grüße an alle.MP3', 'audio/mpeg', 'speech-Gr-e-an-alle.mp3'],
    ['../../etc/passwd', '', 'speech-etc-passwd.wav'],
    ['Recording', 'audio/webm;codecs=opus', 'speech-Recording.webm'],
    ['你好.m4a', 'audio/x-m4a', 'speech.m4a'],
  ])('of %s is plain', (label, type, name) => {
    expect(freeName(label, type, new Set())).toBe(name);
  });

  it('is numbered where it is taken', () => {
    expect(freeName('a.wav', 'audio/wav', new Set(['speech-a.wav', 'speech-a-2.wav']))).toBe('speech-a-3.wav');
  });
});
