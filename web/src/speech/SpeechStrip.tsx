/** The strip of the timeline that shows speech closely: waveform, visemes, and what can be done to the one in hand. */
import type { JSX } from 'preact';
import { useEffect, useRef } from 'preact/hooks';
import { Button, IconButton } from '../shell/Button';
import { canPose, timeSeconds } from '../store/state';
import { changed, endOf, removed } from './blocks';
import { editBlocks } from './retracking';
import { clip } from './sound';
import { blocks, selectedIndex } from './state';
import { followPlayhead, scrollStrip, shownSpan, timeAt, zoomStrip } from './stripView';
import { VisemeLane } from './VisemeLane';
import { SOUNDS, VISEMES, type Viseme } from './visemes';
import { StripPlayhead, Waveform } from './Waveform';

export function SpeechStrip(): JSX.Element | null {
  const hasBlocks = blocks.value !== null;
  if (!clip.value && !hasBlocks) return null;
  return (
    <section class="speech-strip" aria-label="Speech">
      <div class="strip-tools">
        <span class="strip-label">Speech</span>
        {hasBlocks && <BlockTools />}
        <div class="strip-zoom">
          <IconButton icon="zoomOut" label="Show more of the speech" onClick={() => zoomStrip(-1, timeSeconds.value)} />
          <IconButton icon="zoom" label="Show the speech closer" onClick={() => zoomStrip(1, timeSeconds.value)} />
        </div>
      </div>
      <Lanes hasBlocks={hasBlocks} />
    </section>
  );
}

function Lanes({ hasBlocks }: { readonly hasBlocks: boolean }): JSX.Element {
  const lanes = useRef<HTMLDivElement>(null);
  useEffect(followPlayhead, []);
  useEffect(() => listenToWheel(lanes.current), []);
  return (
    <div class="strip-lanes" ref={lanes}>
      {clip.value && <Waveform />}
      {hasBlocks && <VisemeLane />}
      <StripPlayhead />
    </div>
  );
}

/** The viseme in hand: what it is, and its end. */
function BlockTools(): JSX.Element {
  const all = blocks.value ?? [];
  const index = selectedIndex.value;
  const block = index === null ? undefined : all[index];
  if (index === null || !block) return <span class="quiet">Drag visemes or their edges; double-click adds one</span>;
  const disabled = !canPose.value;
  return (
    <>
      <select
        class="select"
        aria-label="Viseme"
        disabled={disabled}
        value={block.viseme}
        onChange={(event) => editBlocks(changed(all, index, event.currentTarget.value as Viseme))} // the options are the visemes
      >
        {VISEMES.map((viseme) => (
          <option key={viseme} value={viseme}>{`${viseme} – ${SOUNDS[viseme]}`}</option>
        ))}
      </select>
      <span class="quiet numeric">{`${block.t.toFixed(2)}–${endOf(block).toFixed(2)} s`}</span>
      <Button
        emphasis="quiet"
        disabled={disabled}
        onClick={() => {
          editBlocks(removed(all, index));
          selectedIndex.value = null;
        }}
      >
        Remove
      </Button>
    </>
  );
}

/** The wheel scrolls, with Ctrl it zooms about the pointer. Listened to by hand, as it must be allowed to prevent. */
function listenToWheel(element: HTMLElement | null): (() => void) | undefined {
  if (!element) return undefined;
  const wheel = (event: WheelEvent) => {
    event.preventDefault();
    const box = element.getBoundingClientRect();
    const { start, end } = shownSpan.value;
    if (event.ctrlKey) zoomStrip(event.deltaY < 0 ? 1 : -1, timeAt(event.clientX, box, shownSpan.value));
    else scrollStrip(((event.deltaX || event.deltaY) / box.width) * (end - start));
  };
  element.addEventListener('wheel', wheel, { passive: false });
  return () => element.removeEventListener('wheel', wheel);
}
