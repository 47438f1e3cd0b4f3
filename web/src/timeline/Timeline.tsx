/** Transport, track menu and the curves of the track on the timeline. */
import { useComputed } from '@preact/signals';
import type { JSX } from 'preact';
import type { Track } from '../api/schema';
import { Button, IconButton } from '../shell/Button';
import { SpeechStrip } from '../speech/SpeechStrip';
import { captions } from '../speech/state';
import { toggle } from '../store/looking';
import { canPose, captionsShown, looping, playing, timeSeconds, track } from '../store/state';
import { insertKeyframe, useTrack } from '../store/tracks';
import { demoTrack } from './demo';
import { KeyLane } from './KeyLane';
import { keyframesOf } from './keyframes';
import { type Lane, lanesOf } from './lanes';
import { rewind, seek, togglePlaying } from './playback';
import { TrackMenu } from './TrackMenu';

export function Timeline(): JSX.Element {
  const current = track.value;
  const disabled = !canPose.value || !current;
  return (
    <section class="timeline" aria-label="Timeline">
      <div class="transport">
        <IconButton
          icon={playing.value ? 'pause' : 'play'}
          label={playing.value ? 'Pause' : 'Play'}
          keys="Space"
          disabled={disabled}
          onClick={togglePlaying}
        />
        <IconButton icon="reset" label="Back to the start" keys="Home" disabled={disabled} onClick={rewind} />
        <IconButton icon="loop" label="Loop" keys="O" pressed={looping.value} onClick={() => toggle(looping)} />
        <IconButton
          icon="captions"
          label={captions.value.length > 0 ? 'Captions' : 'Captions: write what is said in the Speech panel'}
          keys="W"
          pressed={captionsShown.value && captions.value.length > 0}
          disabled={captions.value.length === 0}
          onClick={() => toggle(captionsShown)}
        />
        <IconButton icon="key" label="Keyframe of the pose" keys="I" disabled={!canPose.value} onClick={insertKeyframe} />
        <Clock duration={current?.duration ?? 0} />
        <TrackMenu />
      </div>
      <SpeechStrip />
      {current ? <Lanes key={current.name} disabled={disabled} /> : <Invitation />}
    </section>
  );
}

function Invitation(): JSX.Element {
  return (
    <div class="timeline-empty">
      <Button disabled={!canPose.value} onClick={() => useTrack(demoTrack())}>
        Play the demo
      </Button>
      <p class="quiet">Blink, smile, speak, tilt. A track plays on top of your pose.</p>
    </div>
  );
}

function Clock({ duration }: { readonly duration: number }): JSX.Element {
  return (
    <span class="clock numeric">
      {clock(timeSeconds.value)} <span class="quiet">/ {clock(duration)}</span>
    </span>
  );
}

function Lanes({ disabled }: { readonly disabled: boolean }): JSX.Element | null {
  const lanes = useComputed(() => (track.value ? lanesOf(track.value) : []));
  const current = track.value;
  if (!current) return null;
  return (
    <div class="lanes">
      <div class="lane-labels" aria-hidden="true">
        {keyframesOf(current).length > 0 && <span class="keys">Keys</span>}
        {lanes.value.map(({ label }) => (
          <span key={label}>{label}</span>
        ))}
      </div>
      <div class="lane-curves">
        <KeyLane track={current} disabled={disabled} />
        {lanes.value.map((lane) => (
          <Curve key={lane.label} lane={lane} />
        ))}
        <Playhead duration={current.duration} />
        <Scrubber track={current} disabled={disabled} />
      </div>
    </div>
  );
}

/** Apart from the curves, which are not drawn anew while a track plays. */
function Scrubber({ track: { duration, fps }, disabled }: { readonly track: Track; readonly disabled: boolean }): JSX.Element {
  return (
    <input
      class="scrubber"
      type="range"
      aria-label="Playhead"
      aria-valuetext={`${timeSeconds.value.toFixed(2)} seconds`}
      min={0}
      max={duration}
      step={1 / fps}
      value={timeSeconds.value}
      disabled={disabled}
      onInput={(event) => seek(event.currentTarget.valueAsNumber)}
    />
  );
}

function Playhead({ duration }: { readonly duration: number }): JSX.Element {
  return <i class="playhead" style={{ left: `${(timeSeconds.value / duration) * 100}%` }} />;
}

const LANE_HEIGHT = 100;

function Curve({ lane: { label, values } }: { readonly lane: Lane }): JSX.Element {
  const top = (value: number) => (LANE_HEIGHT * (1 - 0.85 * value)).toFixed(1);
  const line = values.map((value, frame) => `L${frame} ${top(value)}`).join('');
  return (
    <svg
      class={`curve ${label.toLowerCase()}`}
      viewBox={`0 0 ${Math.max(1, values.length - 1)} ${LANE_HEIGHT}`}
      preserveAspectRatio="none"
      aria-hidden="true"
    >
      <path d={`M0 ${LANE_HEIGHT}${line}V${LANE_HEIGHT}Z`} />
    </svg>
  );
}

/** "0:01.24". */
function clock(seconds: number): string {
  const minutes = Math.floor(seconds / 60);
  return `${minutes}:${(seconds - 60 * minutes).toFixed(2).padStart(5, '0')}`;
}
