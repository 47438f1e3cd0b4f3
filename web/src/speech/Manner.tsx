/** How it is spoken: style, opening, smoothness, and how much lips, lids, head and brows join in. */
import type { JSX } from 'preact';
import type { SpeechOptions } from '../api/schema';
import { IconButton } from '../shell/Button';
import { choose, sketchChoice } from './retracking';
import { choices } from './state';

type Style = SpeechOptions['style'];

const STYLES: readonly { readonly name: Style; readonly label: string }[] = [
  { name: 'subtle', label: 'Subtle' },
  { name: 'normal', label: 'Normal' },
  { name: 'cartoon', label: 'Cartoon' },
];

const GROUPS = [
  { name: 'mouth', label: 'Lips' },
  { name: 'blink', label: 'Blinks' },
  { name: 'head', label: 'Head' },
  { name: 'brows', label: 'Brows' },
] as const;

const MOST = { amplitude: 2, smoothing: 4, gain: 2 };

export function Manner({ disabled }: { readonly disabled: boolean }): JSX.Element {
  const { style, amplitude, smoothing } = choices.value.options;
  return (
    <fieldset class="speech-section manner" aria-label="Manner" disabled={disabled}>
      <div class="segmented">
        {STYLES.map(({ name, label }) => (
          <label key={name}>
            <input type="radio" name="speech-style" checked={style === name} onChange={() => choose({ style: name })} />
            <span>{label}</span>
          </label>
        ))}
      </div>
      <Slider
        label="Opening"
        ends={['mumble', 'shout']}
        most={MOST.amplitude}
        value={amplitude}
        option={(value) => ({ amplitude: value })}
      />
      <Slider label="Flow" ends={['crisp', 'smooth']} most={MOST.smoothing} value={smoothing} option={(value) => ({ smoothing: value })} />
      {GROUPS.map((group) => (
        <Gain key={group.name} {...group} />
      ))}
    </fieldset>
  );
}

/** How much a group of channels moves; muted groups stay at rest. */
function Gain({ name, label }: (typeof GROUPS)[number]): JSX.Element {
  const { gains } = choices.value.options;
  const gain = gains[name] ?? 1;
  return (
    <div class="gain">
      <Slider
        label={label}
        ends={['still', 'lively']}
        most={MOST.gain}
        value={gain}
        option={(value) => ({ gains: { ...gains, [name]: value } })}
      />
      <IconButton
        icon={gain > 0 ? 'eye' : 'hidden'}
        label={`Mute ${label.toLowerCase()}`}
        pressed={gain === 0}
        onClick={() => choose({ gains: { ...gains, [name]: gain > 0 ? 0 : 1 } })}
      />
    </div>
  );
}

type SliderProps = {
  readonly label: string;
  readonly ends: readonly [string, string];
  readonly most: number;
  readonly value: number;
  readonly option: (value: number) => Partial<SpeechOptions>;
};

/** From 0 to `most`; a double click is back at 1. */
function Slider({ label, ends, most, value, option }: SliderProps): JSX.Element {
  return (
    <div class="channel">
      <span class="channel-label">{label}</span>
      <div class="channel-track">
        <span class="end">{ends[0]}</span>
        <input
          type="range"
          aria-label={`${label}: ${ends[0]} to ${ends[1]}`}
          style={{ '--to': `${(value / most) * 100}%` }}
          min={0}
          max={most}
          step={0.05}
          value={value}
          onInput={(event) => sketchChoice(option(event.currentTarget.valueAsNumber))}
          onChange={(event) => choose(option(event.currentTarget.valueAsNumber))}
          onDblClick={() => choose(option(1))}
        />
        <span class="end">{ends[1]}</span>
      </div>
      <output class="numeric">{`${Math.round(value * 100)} %`}</output>
    </div>
  );
}
