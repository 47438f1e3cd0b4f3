/** The clock of the timeline: play, pause, scrub, loop. */
import { leaveRest } from '../store/looking';
import { looping, playing, timeSeconds, track } from '../store/state';

let request = 0;
let lastTick = 0;

export function play(): void {
  const current = track.value;
  if (!current || playing.value) return;
  if (timeSeconds.value >= current.duration) timeSeconds.value = 0;
  leaveRest();
  playing.value = true;
  lastTick = performance.now();
  request = requestAnimationFrame(tick);
}

export function pause(): void {
  playing.value = false;
  cancelAnimationFrame(request);
}

export function togglePlaying(): void {
  if (playing.value) pause();
  else play();
}

/** Moves the playhead, within the track. */
export function seek(seconds: number): void {
  leaveRest();
  timeSeconds.value = Math.min(Math.max(seconds, 0), track.value?.duration ?? 0);
}

export function stepFrames(count: number): void {
  pause();
  seek(timeSeconds.value + count / (track.value?.fps ?? 25));
}

/** Back to the start, where the track has no effect. */
export function rewind(): void {
  pause();
  timeSeconds.value = 0;
}

function tick(now: number): void {
  const current = track.value;
  if (!current || !playing.value) return pause();
  const next = timeSeconds.value + (now - lastTick) / 1000;
  lastTick = now;
  if (next < current.duration) timeSeconds.value = next;
  else if (looping.value) timeSeconds.value = next % current.duration;
  else {
    timeSeconds.value = current.duration;
    return pause();
  }
  request = requestAnimationFrame(tick);
}
