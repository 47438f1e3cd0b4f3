/** What is being said, written at the foot of the stage. */
import { useComputed } from '@preact/signals';
import type { JSX } from 'preact';
import { cueAt } from '../speech/captions';
import { captions } from '../speech/state';
import { captionsShown, timeSeconds } from '../store/state';

export function Caption(): JSX.Element | null {
  const text = useComputed(() =>
    captionsShown.value && timeSeconds.value > 0 ? cueAt(captions.value, timeSeconds.value)?.text : null,
  ).value;
  if (!text) return null;
  return (
    <p class="caption">
      <span>{text}</span>
    </p>
  );
}
