/** Two soft notes that say that something is done. */

const NOTES = [
  { hertz: 659.26, start: 0 }, // E5
  { hertz: 880, start: 0.16 }, // A5
] as const;
const LOUDNESS = 0.12; // of full scale
const ATTACK_SECONDS = 0.02;
const DECAY_SECONDS = 0.7;

/** Plays where the browser lets a page sound: after a press on it. */
export async function chime(): Promise<void> {
  const context = new AudioContext();
  const ends = NOTES.map(({ hertz, start }) => note(context, hertz, context.currentTime + start));
  await Promise.all(ends);
  await context.close();
}

function note(context: AudioContext, hertz: number, start: number): Promise<unknown> {
  const envelope = new GainNode(context, { gain: 0 });
  envelope.gain.setValueAtTime(0, start);
  envelope.gain.linearRampToValueAtTime(LOUDNESS, start + ATTACK_SECONDS);
  envelope.gain.exponentialRampToValueAtTime(LOUDNESS / 1000, start + DECAY_SECONDS);
  const tone = new OscillatorNode(context, { frequency: hertz });
  tone.connect(envelope).connect(context.destination);
  tone.start(start);
  tone.stop(start + DECAY_SECONDS);
  return new Promise((resolve) => {
    tone.onended = resolve;
  });
}
