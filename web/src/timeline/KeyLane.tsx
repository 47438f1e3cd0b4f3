/** The keyframes of the track as diamonds over its curves: a press goes there, Delete removes. */
import type { JSX } from 'preact';
import type { Track } from '../api/schema';
import { removeKeyframe } from '../store/tracks';
import { keyframesOf } from './keyframes';
import { seek } from './playback';

export function KeyLane({ track, disabled }: { readonly track: Track; readonly disabled: boolean }): JSX.Element | null {
  const keyframes = keyframesOf(track);
  if (keyframes.length === 0) return null;
  const remove = (event: KeyboardEvent, t: number) => {
    if (event.key !== 'Delete' && event.key !== 'Backspace') return;
    event.preventDefault();
    removeKeyframe(t);
  };
  return (
    <fieldset class="key-lane" aria-label="Keyframes">
      {keyframes.map(({ t }) => (
        <button
          key={t}
          type="button"
          class="key"
          style={{ left: `${(t / track.duration) * 100}%` }}
          aria-label={`Keyframe at ${t.toFixed(2)} seconds`}
          title="Go to this keyframe; Delete or a double click removes it"
          disabled={disabled}
          onClick={() => seek(Math.max(t, 1 / track.fps / 2))}
          onDblClick={() => removeKeyframe(t)}
          onKeyDown={(event) => remove(event, t)}
        />
      ))}
    </fieldset>
  );
}
