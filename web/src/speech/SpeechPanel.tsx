/** The speech panel: a sound, its words, how it is spoken, and tracks from and for other programs. */
import type { JSX } from 'preact';
import { Button } from '../shell/Button';
import { canPose, track } from '../store/state';
import { cancelListening } from './listening';
import { Manner } from './Manner';
import { SoundSource } from './SoundSource';
import { type Tier, tierOf } from './speechTrack';
import { listening } from './state';
import { TrackFiles } from './TrackFiles';
import { Words } from './Words';
import './speech.css';

export function SpeechPanel(): JSX.Element {
  const disabled = !canPose.value;
  return (
    <div class="speech-panel">
      <SoundSource disabled={disabled} />
      <Course />
      <Words disabled={disabled} />
      <Manner disabled={disabled} />
      <TrackFiles disabled={disabled} />
    </div>
  );
}

const TIERS: Readonly<Record<Tier, string>> = {
  rough: 'Rough preview: the jaw follows the loudness.',
  audio: 'Lips from the sound alone. Type the words for better ones.',
  transcript: 'Lips from the sound and its words.',
  edited: 'Lips as you edited them.',
};

/** What is under way, or how the track on the timeline came about. */
function Course(): JSX.Element | null {
  const now = listening.value;
  const tier = tierOf(track.value);
  if (now.kind === 'idle') return tier && <p class="speech-tier quiet">{TIERS[tier]}</p>;
  const text = now.kind === 'opening' ? `Opening ${now.label}…` : now.kind === 'sending' ? 'Sending the sound…' : `${sentence(now.stage)}…`;
  return (
    <section class="speech-course" aria-label="Listening">
      <span>{text}</span>
      <Button emphasis="quiet" onClick={cancelListening}>
        Cancel
      </Button>
      <progress aria-label="Progress of the listening" max={1} value={now.kind === 'listening' ? now.progress : undefined} />
    </section>
  );
}

const sentence = (text: string) => text.charAt(0).toUpperCase() + text.slice(1);
