/** The stage: the portrait as live SVG, its landmarks, and what floats above them. */
import { useSignalEffect } from '@preact/signals';
import type { JSX } from 'preact';
import { useEffect, useRef } from 'preact/hooks';
import { NoticeBar } from '../shell/NoticeBar';
import { useObjectUrl } from '../shell/useObjectUrl';
import { comparing, mirrored, playing, portrait, scene, session, tool } from '../store/state';
import { Caption } from './Caption';
import { FaceBoxes } from './FaceBoxes';
import { Hint } from './Hint';
import { listenToHandleKeys } from './handleKeys';
import { Insets } from './Insets';
import { Pins, PinsCard } from './Pins';
import { Progress } from './Progress';
import { listenToPointers } from './pointer';
import { startRendering } from './render';
import { StageOptions } from './StageOptions';
import { panning, toolInHand, toolNamed } from './toolInHand';
import { hoveredTarget, stageSize } from './viewState';

export function Stage(): JSX.Element {
  const stage = useRef<HTMLElement>(null);
  const scenery = useRef<SVGSVGElement>(null);
  const picture = useRef<SVGSVGElement>(null);
  const slot = useRef<SVGGElement>(null);
  const overlay = useRef<SVGSVGElement>(null);
  useEffect(() => {
    if (!stage.current || !scenery.current || !picture.current || !slot.current || !overlay.current) return;
    const stops = [
      followSize(stage.current),
      startRendering({ scenery: scenery.current, picture: picture.current, slot: slot.current, overlay: overlay.current }),
      listenToPointers(stage.current, { tool: toolInHand, panning: () => panning.value, panTool: toolNamed('pan') }),
      listenToHandleKeys(overlay.current),
    ];
    return () => {
      for (const stop of stops) stop();
    };
  }, []);
  useSignalEffect(() => {
    stage.current?.setAttribute('data-cursor', panning.value ? 'pan' : (hoveredTarget.value?.kind ?? tool.value));
  });
  return (
    <main
      class={`stage tool-${tool.value} ${session.value.kind} ${playing.value ? 'playing' : ''} ${mirrored.value ? 'mirrored' : ''}`}
      ref={stage}
      aria-label="Stage"
    >
      <svg class="picture" ref={scenery} aria-hidden="true" />
      <svg class="picture" ref={picture} role="img" aria-label={portrait.value ? `Portrait ${portrait.value.name}` : 'Empty stage'}>
        <g ref={slot} />
        <SourcePicture />
      </svg>
      <svg class="overlay" ref={overlay} aria-label="Landmarks" />
      <UploadPreview />
      <FaceBoxes />
      <Pins />
      <Insets />
      <StageOptions />
      <Hint />
      <Caption />
      <div class="stage-messages" data-own-pointer>
        <NoticeBar />
        <Progress />
        <PinsCard />
      </div>
    </main>
  );
}

/** The portrait itself: it dissolves into the first coarse paths, and comes back for a comparison. */
function SourcePicture(): JSX.Element | null {
  const open = portrait.value;
  const url = useObjectUrl(open?.picture ?? null);
  if (!open || !url) return null;
  const isDissolved = scene.value !== null && !comparing.value;
  return (
    <image
      class={isDissolved ? 'source dissolved' : 'source'}
      href={url}
      width={open.width}
      height={open.height}
      preserveAspectRatio="none"
    />
  );
}

/** The picture while it is on its way to the server, before its size is known. */
function UploadPreview(): JSX.Element | null {
  const now = session.value;
  const url = useObjectUrl(now.kind === 'uploading' ? now.picture : null);
  if (now.kind !== 'uploading' || !url) return null;
  return (
    <div class="upload-preview">
      <img src={url} alt={now.name} />
    </div>
  );
}

function followSize(stage: HTMLElement): () => void {
  const observer = new ResizeObserver(([entry]) => {
    const { width, height } = entry.contentRect;
    stageSize.value = { width, height };
  });
  observer.observe(stage);
  return () => observer.disconnect();
}
