/** Named expressions of the pose panel. Vowels: the speech handbook's articulator targets (section 2) for aa, E, I, O, U. */

export type Preset = { readonly name: string; readonly label: string; readonly articulators: Readonly<Record<string, number>> };

export const PRESETS: readonly Preset[] = [
  { name: 'neutral', label: 'Neutral', articulators: {} },
  { name: 'a', label: 'A', articulators: { jaw: 1, width: 0.1, upper_raise: 0.3, lower_raise: 0.3 } },
  { name: 'e', label: 'E', articulators: { jaw: 0.7, width: 0.4, upper_raise: 0.3, lower_raise: 0.2 } },
  { name: 'i', label: 'I', articulators: { jaw: 0.4, width: 0.7, upper_raise: 0.3, lower_raise: 0.2, tongue_tip: 0.2 } },
  { name: 'o', label: 'O', articulators: { jaw: 0.7, width: -0.4, round: 0.7, upper_raise: 0.1, lower_raise: 0.1 } },
  { name: 'u', label: 'U', articulators: { jaw: 0.3, width: -0.7, round: 1, upper_raise: 0.1, lower_raise: 0.1 } },
  {
    name: 'smile',
    label: 'Smile',
    articulators: { smile: 0.8, width: 0.3, brow_left: 0.15, brow_right: 0.15, blink_left: 0.15, blink_right: 0.15 },
  },
  {
    name: 'surprised',
    label: 'Surprised',
    articulators: { jaw: 0.6, round: 0.3, brow_left: 0.9, brow_right: 0.9, blink_left: -0.3, blink_right: -0.3 },
  },
  { name: 'blink', label: 'Blink', articulators: { blink_left: 1, blink_right: 1 } },
  {
    name: 'asleep',
    label: 'Asleep',
    articulators: { blink_left: 1, blink_right: 1, jaw: 0.12, pitch: 6, roll: 5, brow_left: -0.2, brow_right: -0.2 },
  },
];
