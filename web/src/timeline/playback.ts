/** The transport of the timeline: play, pause, scrub, loop. Where there is sound, its clock leads. */
import { sound } from '../speech/sound';
import { soundClock } from '../speech/soundClock';
import { leaveRest } from '../store/looking';
import { looping, playing, timeSeconds, track } from '../store/state';
import { type Clock, wallClock } from './clock';
import { inFrame } from './frame';

let cancelTick = () => {};
let clock: Clock | null = null;
/** What `clock` plays. */
let heard = sound.peek();

export function play(): void {
  const current = track.value;
  if (!current || playing.value) return;
  leaveRest();
  playing.value = true;
  startClock(timeSeconds.value < current.duration ? timeSeconds.value : 0);
  cancelTick = inFrame(tick);
}

export function pause(): void {
  playing.value = false;
  cancelTick();
  stopClock();
}

export function togglePlaying(): void {
  if (playing.value) pause();
  else play();
}

/** Moves the playhead, within the track. */
export function seek(seconds: number): void {
  leaveRest();
  const within = Math.min(Math.max(seconds, 0), track.value?.duration ?? 0);
  if (playing.value) startClock(within);
  else timeSeconds.value = within;
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

function startClock(from: number): void {
  stopClock();
  timeSeconds.value = from;
  heard = sound.value;
  clock = heard ? soundClock(heard.buffer, from) : wallClock(from);
}

function stopClock(): void {
  clock?.stop();
  clock = null;
}

function tick(): void {
  const current = track.value;
  if (!current || !clock || !playing.value) return pause();
  if (heard !== sound.value) startClock(timeSeconds.value);
  const next = clock.seconds();
  if (next < current.duration) timeSeconds.value = next;
  else if (looping.value) startClock(next % current.duration);
  else {
    timeSeconds.value = current.duration;
    return pause();
  }
  cancelTick = inFrame(tick);
}
