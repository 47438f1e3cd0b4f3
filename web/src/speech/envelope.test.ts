import { describe, expect, it } from 'vitest';
import { envelopeOf, peaksOf, roughTrack, type Samples } from './envelope';

const RATE = 8000;

/** A 200 Hz tone of `amplitude` from `start` to `end`, silence round it, one second in all. */
function tone(amplitude: number, start: number, end: number): Samples {
  const values = Float32Array.from({ length: RATE }, (_, k) => {
    const time = k / RATE;
    return time >= start && time < end ? amplitude * Math.sin(2 * Math.PI * 200 * time) : 0;
  });
  return { values, rate: RATE };
}

describe('envelope', () => {
  it('is the root mean square of a tone, 50 times a second', () => {
    const envelope = envelopeOf(tone(0.5, 0.4, 0.6));
    expect(envelope).toHaveLength(50);
    expect(envelope[25]).toBeCloseTo(0.5 / Math.SQRT2, 3);
    expect(envelope[10]).toBe(0);
  });
});

describe('rough track', () => {
  it('opens the jaw where there is sound, and at once', () => {
    const { articulators, duration, fps } = roughTrack(tone(0.5, 0.4, 0.6), 'hum');
    const jaw = articulators?.jaw ?? [];
    expect(jaw.length).toBe(duration * fps);
    expect(Math.max(...jaw.slice(0, 19))).toBe(0);
    expect(jaw[20]).toBeGreaterThan(0.4); // half the window has sound
    expect(jaw[25]).toBeCloseTo(0.8);
    expect(jaw[40]).toBeLessThan(0.01);
  });

  it('stays shut for noise below −60 dB', () => {
    expect(Math.max(...(roughTrack(tone(5e-4, 0, 1), 'hiss').articulators?.jaw ?? []))).toBe(0);
  });
});

describe('peaks', () => {
  it('finds the largest magnitude of each part', () => {
    const peaks = peaksOf(tone(0.5, 0.5, 0.6), 0, 1, 10);
    expect(Array.from(peaks, (peak) => Math.round(peak * 10) / 10)).toEqual([0, 0, 0, 0, 0, 0.5, 0, 0, 0, 0]);
  });

  it('is silent beyond the end of the sound', () => {
    expect(Array.from(peaksOf(tone(0.5, 0, 1), 1, 2, 2))).toEqual([0, 0]);
  });
});
