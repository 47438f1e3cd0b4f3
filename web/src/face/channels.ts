/** The articulator channels as people see them: words for both ends, range and group. Names and ranges: docs/architecture.md. */

export type Channel = {
  readonly name: string;
  readonly label: string;
  /** Words at the low and the high end of the slider. */
  readonly ends: readonly [string, string];
  readonly min: number;
  readonly max: number;
  readonly step: number;
  readonly unit: '' | '°';
};

export type ChannelGroup = { readonly name: string; readonly label: string; readonly channels: readonly Channel[] };

function unit(name: string, label: string, low: string, high: string, min = 0): Channel {
  return { name, label, ends: [low, high], min, max: 1, step: 0.01, unit: '' };
}

function angle(name: string, label: string, low: string, high: string, limit: number): Channel {
  return { name, label, ends: [low, high], min: -limit, max: limit, step: 0.5, unit: '°' };
}

export const CHANNEL_GROUPS: readonly ChannelGroup[] = [
  {
    name: 'mouth',
    label: 'Mouth',
    channels: [
      unit('jaw', 'Jaw', 'closed', 'open'),
      unit('width', 'Width', 'narrow', 'wide', -1),
      unit('round', 'Round', 'flat', 'pursed'),
      unit('smile', 'Corners', 'frown', 'smile', -1),
      unit('upper_raise', 'Upper lip', 'rest', 'raised'),
      unit('lower_raise', 'Lower lip', 'rest', 'tucked'),
      unit('press', 'Lips', 'loose', 'pressed'),
      unit('tongue_tip', 'Tongue', 'down', 'up'),
    ],
  },
  {
    name: 'eyes',
    label: 'Eyes',
    channels: [
      unit('blink_left', 'Left lid', 'wide', 'shut', -0.3),
      unit('blink_right', 'Right lid', 'wide', 'shut', -0.3),
      unit('gaze_x', 'Look', 'left', 'right', -1),
      unit('gaze_y', 'Look', 'up', 'down', -1),
    ],
  },
  {
    name: 'brows',
    label: 'Brows',
    channels: [unit('brow_left', 'Left brow', 'low', 'high', -1), unit('brow_right', 'Right brow', 'low', 'high', -1)],
  },
  {
    name: 'head',
    label: 'Head',
    // Limits that read well on flat drawings (rigging handbook, section 7).
    channels: [
      angle('yaw', 'Turn', 'left', 'right', 20),
      angle('pitch', 'Nod', 'up', 'down', 12),
      angle('roll', 'Tilt', 'left', 'right', 15),
    ],
  },
];

export const CHANNELS: readonly Channel[] = CHANNEL_GROUPS.flatMap((group) => group.channels);

const BY_NAME = new Map(CHANNELS.map((channel) => [channel.name, channel]));

/** `value` within the channel's range; unknown channels are kept as they are, for newer files. */
export function clampChannel(name: string, value: number): number {
  const channel = BY_NAME.get(name);
  return channel ? Math.min(channel.max, Math.max(channel.min, value)) : value;
}
