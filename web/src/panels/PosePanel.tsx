/** Sliders of all articulators, presets and resets. */
import { useComputed } from '@preact/signals';
import type { JSX } from 'preact';
import { CHANNEL_GROUPS, type Channel, type ChannelGroup } from '../face/channels';
import { PRESETS } from '../face/presets';
import { Button, IconButton } from '../shell/Button';
import { atRest, type Edit, isAtRest, withArticulators, withChannel, withoutChannels, withoutGroup } from '../store/edit';
import { apply, settle, sketch } from '../store/editing';
import { leaveRest } from '../store/looking';
import { canPose, edit } from '../store/state';
import { pinChannel } from '../store/tracks';

/** One step that is seen, whatever tool is in hand. */
function pose(change: (edit: Edit) => Edit): void {
  leaveRest();
  apply(change);
}

function sketchPose(next: Edit): void {
  leaveRest();
  sketch(next);
}

export function PosePanel(): JSX.Element {
  const disabled = !canPose.value;
  const isResting = useComputed(() => isAtRest(edit.value.pose)).value;
  return (
    <div class="pose-panel">
      <Presets disabled={disabled} />
      {CHANNEL_GROUPS.map((group) => (
        <Group key={group.name} group={group} disabled={disabled} />
      ))}
      <Button disabled={disabled || isResting} onClick={() => pose(atRest)}>
        Reset the whole pose
      </Button>
    </div>
  );
}

function Presets({ disabled }: { readonly disabled: boolean }): JSX.Element {
  return (
    <fieldset class="presets" aria-label="Presets">
      {PRESETS.map(({ name, label, articulators }) => (
        <button
          key={name}
          type="button"
          class="chip"
          disabled={disabled}
          onClick={() => pose((present) => (name === 'neutral' ? atRest(present) : withArticulators(present, articulators)))}
        >
          {label}
        </button>
      ))}
    </fieldset>
  );
}

function Group({ group, disabled }: { readonly group: ChannelGroup; readonly disabled: boolean }): JSX.Element {
  const isMoved = useComputed(() => group.channels.some(({ name }) => (edit.value.pose.articulators[name] ?? 0) !== 0)).value;
  return (
    <fieldset class="channel-group" disabled={disabled}>
      <legend>{group.label}</legend>
      <IconButton
        icon="reset"
        label={`Reset ${group.label.toLowerCase()}`}
        disabled={disabled || !isMoved}
        onClick={() => pose((present) => withoutGroup(present, group.name))}
      />
      {group.channels.map((channel) => (
        <Slider key={channel.name} channel={channel} />
      ))}
    </fieldset>
  );
}

function Slider({ channel }: { readonly channel: Channel }): JSX.Element {
  const value = useComputed(() => edit.value.pose.articulators[channel.name] ?? 0).value;
  const name = `${channel.label}: ${channel.ends[0]} to ${channel.ends[1]}`;
  const share = (v: number) => `${((v - channel.min) / (channel.max - channel.min)) * 100}%`;
  const reset = () => pose((present) => withoutChannels(present, [channel.name]));
  return (
    <div class="channel">
      <span class="channel-label">{channel.label}</span>
      <div class="channel-track">
        <span class="end">{channel.ends[0]}</span>
        <input
          type="range"
          aria-label={name}
          style={{ '--from': share(Math.min(0, value)), '--to': share(Math.max(0, value)) }}
          min={channel.min}
          max={channel.max}
          step={channel.step}
          value={value}
          onInput={(event) => sketchPose(withChannel(edit.value, channel.name, event.currentTarget.valueAsNumber))}
          onChange={settle}
          onDblClick={reset}
        />
        <span class="end">{channel.ends[1]}</span>
      </div>
      <NumberField channel={channel} value={value} />
      <IconButton
        icon="key"
        label={`Keyframe of ${channel.label.toLowerCase()}, ${channel.ends[0]} to ${channel.ends[1]}`}
        onClick={() => pinChannel(channel.name)}
      />
    </div>
  );
}

function NumberField({ channel, value }: { readonly channel: Channel; readonly value: number }): JSX.Element {
  const take = (event: Event & { currentTarget: HTMLInputElement }) => {
    const typed = event.currentTarget.valueAsNumber;
    if (Number.isFinite(typed)) pose((present) => withChannel(present, channel.name, typed));
    event.currentTarget.value = shown(edit.value.pose.articulators[channel.name] ?? 0, channel);
  };
  return (
    <input
      type="number"
      class="numeric"
      aria-label={`${channel.label}, value`}
      min={channel.min}
      max={channel.max}
      step={channel.step}
      value={shown(value, channel)}
      onChange={take}
    />
  );
}

const shown = (value: number, { unit }: Channel) => value.toFixed(unit === '°' ? 1 : 2);
