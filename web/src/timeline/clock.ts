/** Tells where the playhead is while a track plays. */
export type Clock = {
  /** Since the start of the track; never goes back. */
  readonly seconds: () => number;
  readonly stop: () => void;
};

/** The clock of tracks without sound. */
export function wallClock(from: number): Clock {
  const start = performance.now();
  return { seconds: () => from + (performance.now() - start) / 1000, stop: () => {} };
}
