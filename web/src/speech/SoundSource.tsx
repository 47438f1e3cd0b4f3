/** Where the sound comes from: a file, the microphone, or a text that the server speaks. */
import { signal, useSignalEffect } from '@preact/signals';
import type { JSX } from 'preact';
import { useRef } from 'preact/hooks';
import { Button } from '../shell/Button';
import { pickFile } from '../shell/pickFile';
import { report } from '../store/notices';
import { speakText, takeSound } from './listening';
import { meter, recorder, startRecording, stopRecording } from './recorder';
import { clip, sound } from './sound';
import { SOUNDS } from './soundFiles';
import { listening, textToSpeak } from './state';

type Source = 'file' | 'microphone' | 'text';

const SOURCES: readonly { readonly name: Source; readonly label: string }[] = [
  { name: 'file', label: 'File' },
  { name: 'microphone', label: 'Record' },
  { name: 'text', label: 'Type' },
];

const source = signal<Source>('file');

export function SoundSource({ disabled }: { readonly disabled: boolean }): JSX.Element {
  return (
    <section class="speech-section" aria-label="Sound">
      <fieldset class="segmented">
        <legend class="visually-hidden">Where the sound comes from</legend>
        {SOURCES.map(({ name, label }) => (
          <label key={name}>
            <input
              type="radio"
              name="sound-source"
              checked={source.value === name}
              onChange={() => {
                source.value = name;
              }}
            />
            <span>{label}</span>
          </label>
        ))}
      </fieldset>
      {source.value === 'file' && <FromFile disabled={disabled} />}
      {source.value === 'microphone' && <FromMicrophone disabled={disabled} />}
      {source.value === 'text' && <FromText disabled={disabled} />}
    </section>
  );
}

/** Files are dropped anywhere on the page. */
function FromFile({ disabled }: { readonly disabled: boolean }): JSX.Element {
  const spoken = clip.value;
  const choose = () => pickFile(SOUNDS, (file) => takeSound(file, file.name).catch(report));
  if (spoken)
    return (
      <div class="sound-chosen">
        <span>
          <strong>{spoken.name.replace(/^speech-/, '')}</strong>
          <span class="quiet numeric">{sound.value ? ` ${sound.value.buffer.duration.toFixed(1)} s` : ''}</span>
        </span>
        <Button disabled={disabled} onClick={choose}>
          Other sound…
        </Button>
      </div>
    );
  return (
    <div class="sound-drop">
      <p>Drop a recording of speech here</p>
      <Button emphasis="primary" disabled={disabled} onClick={choose}>
        Choose a sound…
      </Button>
      <p class="quiet">WAV, MP3, OGG, FLAC, M4A, WebM, up to 10 minutes</p>
    </div>
  );
}

function FromMicrophone({ disabled }: { readonly disabled: boolean }): JSX.Element {
  const now = recorder.value;
  switch (now.kind) {
    case 'idle':
    case 'refused':
      return (
        <div class="sound-drop">
          {now.kind === 'refused' && <p role="alert">{now.reason}</p>}
          <Button emphasis="primary" disabled={disabled} onClick={() => startRecording().catch(report)}>
            Start recording
          </Button>
          <p class="quiet">It is sent to your VectorTalker server, and nowhere else</p>
        </div>
      );
    case 'asking':
      return (
        <div class="sound-drop" role="status">
          <p>Waiting for the microphone: allow it in the browser’s question.</p>
        </div>
      );
    case 'recording':
      return (
        <div class="sound-drop">
          <Meter />
          <Button emphasis="primary" onClick={stopRecording}>
            Stop and use it
          </Button>
        </div>
      );
    default:
      return now satisfies never;
  }
}

/** Level and seconds are written past the component, which is drawn once. */
function Meter(): JSX.Element {
  const bar = useRef<HTMLMeterElement>(null);
  const time = useRef<HTMLSpanElement>(null);
  useSignalEffect(() => {
    const { level, seconds } = meter.value;
    if (bar.current) bar.current.value = level;
    if (time.current) time.current.textContent = `${seconds.toFixed(1)} s`;
  });
  return (
    <div class="sound-meter">
      <i class="recording-dot" aria-hidden="true" />
      <span class="numeric" ref={time} />
      <meter ref={bar} min={0} max={1} aria-label="Loudness of the microphone" />
    </div>
  );
}

function FromText({ disabled }: { readonly disabled: boolean }): JSX.Element {
  const isBusy = listening.value.kind !== 'idle';
  return (
    <form
      class="sound-text"
      onSubmit={(event) => {
        event.preventDefault();
        speakText(textToSpeak.value).catch(report);
      }}
    >
      <textarea
        rows={3}
        aria-label="Text to speak"
        placeholder="Hello, I am a portrait made of curves."
        value={textToSpeak.value}
        disabled={disabled}
        onInput={(event) => {
          textToSpeak.value = event.currentTarget.value;
        }}
      />
      <button type="submit" class="button primary" disabled={disabled || isBusy || !textToSpeak.value.trim()}>
        Speak it
      </button>
    </form>
  );
}
