/** What is said, for all of the sound or for the part that is selected on the waveform, and in which language. */
import { signal } from '@preact/signals';
import type { JSX } from 'preact';
import type { Span } from '../api/schema';
import { Button } from '../shell/Button';
import { report } from '../store/notices';
import { listenAgain, listenToPart } from './listening';
import { clip } from './sound';
import { blocks, choices, listening, selectedSpan } from './state';

/** Tags that espeak-ng knows; the names come from the browser. */
const LANGUAGES = 'en en-gb de fr es it pt pt-br nl sv da nb fi pl cs hu ro el tr ru uk ar he fa hi ta id vi ko ja cmn yue'.split(' ');
const languageNames = new Intl.DisplayNames(['en'], { type: 'language' });

const partWords = signal('');

export function Words({ disabled }: { readonly disabled: boolean }): JSX.Element {
  const { options } = choices.value;
  const span = selectedSpan.value;
  const isIdle = !disabled && listening.value.kind === 'idle' && clip.value !== null;
  return (
    <section class="speech-section" aria-label="Words">
      {span && blocks.value ? <PartWords span={span} disabled={!isIdle} /> : <AllWords disabled={disabled} isIdle={isIdle} />}
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
    </section>
  );
}

function AllWords({ disabled, isIdle }: { readonly disabled: boolean; readonly isIdle: boolean }): JSX.Element {
  return (
    <>
      <label class="speech-words">
        What is said <span class="quiet">optional, makes the lips far better</span>
        <textarea
          rows={3}
          value={choices.value.transcript}
          disabled={disabled}
          onInput={(event) => {
            choices.value = { ...choices.value, transcript: event.currentTarget.value };
          }}
        />
      </label>
      <Button disabled={!isIdle} onClick={() => listenAgain().catch(report)}>
        Listen again
      </Button>
    </>
  );
}

function PartWords({ span, disabled }: { readonly span: Span; readonly disabled: boolean }): JSX.Element {
  return (
    <>
      <label class="speech-words">
        What is said from {span.start.toFixed(1)} to {span.end.toFixed(1)} s<span class="quiet">optional; the rest stays as it is</span>
        <textarea
          rows={2}
          value={partWords.value}
          onInput={(event) => {
            partWords.value = event.currentTarget.value;
          }}
        />
      </label>
      <div class="row">
        <Button disabled={disabled} onClick={() => listenToPart(span, partWords.value).catch(report)}>
          Listen to this part
        </Button>
        <Button
          emphasis="quiet"
          onClick={() => {
            selectedSpan.value = null;
          }}
        >
          All of it
        </Button>
      </div>
    </>
  );
}
