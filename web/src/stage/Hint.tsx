/** One line at the foot of the stage: what a press here would do. */
import { useComputed } from '@preact/signals';
import type { JSX } from 'preact';
import { playing, session } from '../store/state';
import { standing } from './posing';
import { toolInHand } from './toolInHand';
import { hoveredTarget, view } from './viewState';

export function Hint(): JSX.Element | null {
  const isStopped = useComputed(() => (standing.value?.limit.triangles.length ?? 0) > 0).value;
  if (session.value.kind !== 'editing' && session.value.kind !== 'finding') return null;
  return (
    <p class="hint">
      <span class="numeric">{Math.round(view.value.scale * 100)} %</span>
      {session.value.kind === 'editing' && !playing.value && (
        <span>{isStopped ? 'As far as it goes: the glowing triangles would turn over' : toolInHand().hint(hoveredTarget.value)}</span>
      )}
    </p>
  );
}
