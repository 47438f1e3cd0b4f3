/** The speech panel: a sound, its words, how it is spoken, and tracks from and for other programs. */
import type { JSX } from 'preact';
import { Button } from '../shell/Button';
import { report } from '../store/notices';
import { canPose, track } from '../store/state';
import { cancelListening, listenAgain } from './listening';
import { Manner } from './Manner';
import { SoundSource } from './SoundSource';
import { clip } from './sound';
import { type Tier, tierOf } from './speechTrack';
import { choices, listening, selectedSpan } from './state';
import { TrackFiles } from './TrackFiles';
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

/** Tags that espeak-ng knows; the names come from the browser. */
const LANGUAGES = 'en en-gb de fr es it pt pt-br nl sv da nb fi pl cs hu ro el tr ru uk ar he fa hi ta id vi ko ja cmn yue'.split(' ');
const languageNames = new Intl.DisplayNames(['en'], { type: 'language' });

function Words({ disabled }: { readonly disabled: boolean }): JSX.Element {
  const { transcript, options } = choices.value;
  const isBusy = disabled || listening.value.kind !== 'idle' || !clip.value;
  const span = selectedSpan.value;
  return (
    <section class="speech-section" aria-label="Words">
      <label class="speech-words">
        What is said <span class="quiet">optional, makes the lips far better</span>
        <textarea
          rows={3}
          value={transcript}
          disabled={disabled}
          onInput={(event) => {
            choices.value = { ...choices.value, transcript: event.currentTarget.value };
          }}
        />
      </label>
      <label class="speech-row">
        Language
        <select
          class="select"
          value={options.language}
          disabled={disabled}
          onChange={(event) => {
            choices.value = { ...choices.value, options: { ...options, language: event.currentTarget.value } };
          }}
        >
          {LANGUAGES.map((tag) => (
            <option key={tag} value={tag}>
              {languageNames.of(tag)}
            </option>
          ))}
        </select>
      </label>
      <div class="row">
        <Button disabled={isBusy} onClick={() => listenAgain(null).catch(report)}>
          Listen again
        </Button>
        {span && (
          <Button disabled={isBusy} onClick={() => listenAgain(span).catch(report)}>
            {`Only ${span.start.toFixed(1)} to ${span.end.toFixed(1)} s`}
          </Button>
        )}
      </div>
    </section>
  );
}

const sentence = (text: string) => text.charAt(0).toUpperCase() + text.slice(1);
