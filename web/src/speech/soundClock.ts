/** Plays a sound and tells the time by it: what is heard leads, and the picture follows. */
import type { Clock } from '../timeline/clock';

const LEAD_SECONDS = 0.03; // a start this far ahead is met to the sample

let context: AudioContext | null = null;

/** Starts `buffer` at `from` seconds. Its time stands still until the browser lets the page be heard. */
export function soundClock(buffer: AudioBuffer, from: number): Clock {
  context ??= new AudioContext();
  const heard = context;
  heard.resume().catch(() => {}); // refused before the first click; the clock then waits for the next start
  const source = heard.createBufferSource();
  source.buffer = buffer;
  source.connect(heard.destination);
  const start = heard.currentTime + LEAD_SECONDS;
  source.start(start, from);
  return {
    seconds: () => Math.max(from, from + heard.currentTime - start - (heard.outputLatency || 0)),
    stop: () => source.stop(),
  };
}
