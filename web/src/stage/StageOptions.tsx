/** Switches of the tool in hand and of what the stage shows. */
import type { JSX } from 'preact';
import { IconButton } from '../shell/Button';
import { SOFT_RADII, setSoftRadius, toggle } from '../store/looking';
import {
  canPose,
  comparing,
  ghostShown,
  landmarksShown,
  meshShown,
  mirrored,
  portrait,
  scene,
  singlePoint,
  softRadius,
  tool,
} from '../store/state';

export function StageOptions(): JSX.Element | null {
  if (!canPose.value) return null;
  const canDrag = tool.value === 'pose' || tool.value === 'rest';
  return (
    <div class="stage-options card" role="toolbar" aria-label="Stage options" data-own-pointer>
      {canDrag && <DragOptions />}
      <IconButton icon="points" label="Landmarks" keys="L" pressed={landmarksShown.value} onClick={() => toggle(landmarksShown)} />
      <IconButton icon="mesh" label="Mesh" keys="T" pressed={meshShown.value} onClick={() => toggle(meshShown)} />
      <IconButton icon="ghost" label="Ghost of the rest pose" keys="G" pressed={ghostShown.value} onClick={() => toggle(ghostShown)} />
      <IconButton
        icon="compare"
        label="Compare with the portrait"
        keys="C"
        pressed={comparing.value}
        disabled={!portrait.value?.picture || !scene.value}
        onClick={() => toggle(comparing)}
      />
    </div>
  );
}

function DragOptions(): JSX.Element {
  return (
    <>
      <label class="soft-radius" title="How far a drag reaches ([ and ])">
        <span>Reach</span>
        <input
          type="range"
          min={SOFT_RADII.min}
          max={SOFT_RADII.max}
          step={0.01}
          value={softRadius.value}
          disabled={singlePoint.value}
          aria-valuetext={`${Math.round(softRadius.value * 100)} % of the eye distance`}
          onInput={(event) => setSoftRadius(event.currentTarget.valueAsNumber)}
        />
      </label>
      <IconButton
        icon="single"
        label="Single point"
        keys="S, or Alt while dragging"
        pressed={singlePoint.value}
        onClick={() => toggle(singlePoint)}
      />
      <IconButton icon="mirror" label="Mirrored" keys="M" pressed={mirrored.value} onClick={() => toggle(mirrored)} />
      <hr />
    </>
  );
}
