/** The fifteen visemes (Oculus names): what people read for them, and the mouth shapes of Rhubarb Lip Sync that are nearest. */
import type { VisemeBlock } from '../api/schema';

export type Viseme = VisemeBlock['viseme'];

export const VISEMES: readonly Viseme[] = ['sil', 'PP', 'FF', 'TH', 'DD', 'kk', 'CH', 'SS', 'nn', 'RR', 'aa', 'E', 'I', 'O', 'U'];

/** The sounds of each viseme, as English spells them. */
export const SOUNDS: Readonly<Record<Viseme, string>> = {
  sil: 'rest',
  PP: 'p b m',
  FF: 'f v',
  TH: 'th',
  DD: 't d',
  kk: 'k g h',
  CH: 'ch sh',
  SS: 's z',
  nn: 'n l',
  RR: 'r',
  aa: 'ah',
  E: 'eh',
  I: 'ee',
  O: 'oh',
  U: 'oo',
};

export const isViseme = (value: unknown): value is Viseme => VISEMES.includes(value as Viseme);
