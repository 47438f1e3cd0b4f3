/** The export menu: what can be exported, a forecast before it starts, progress, and Cancel. */
import type { JSX } from 'preact';
import { useEffect, useRef } from 'preact/hooks';
import { Button } from '../shell/Button';
import { captions } from '../speech/state';
import { scene, track } from '../store/state';
import { cancel, type Exporting, type ExportKind, exporting, looped, prepare, prepareLighter, start, videoSize } from './exporting';
import { forecastText, sizeText } from './forecast';
import './export.css';

type Need = 'track' | 'words';

const KINDS: readonly { readonly kind: ExportKind; readonly label: string; readonly about: string; readonly needs: readonly Need[] }[] = [
  { kind: 'svg', label: 'SVG', about: 'The layered picture as it stands on the stage', needs: [] },
  { kind: 'animated', label: 'Animated SVG', about: 'Plays anywhere an image does, without scripts', needs: ['track'] },
  { kind: 'page', label: 'Web page', about: 'One file that moves in any browser, with its sound and captions', needs: ['track'] },
  { kind: 'mp4', label: 'MP4 video', about: 'H.264, for messengers, slides and video editors', needs: ['track'] },
  { kind: 'webm', label: 'WebM video', about: 'VP9, for the web', needs: ['track'] },
  { kind: 'captions', label: 'Captions', about: 'WebVTT: what is said and when, for players and video sites', needs: ['track', 'words'] },
];
const VIDEO_SIZES = [360, 512, 720, 1080];
const LARGE_BYTES = 5_000_000; // slow to open on a phone
const HEAVY_BYTES = 1_000_000; // a second on a slow line

export function ExportMenu(): JSX.Element {
  const details = useRef<HTMLDetailsElement>(null);
  useEffect(() => closeOnLeave(details), []);
  return (
    <details class="export-menu" ref={details} onToggle={(event) => !event.currentTarget.open && cancel()}>
      <summary class="button primary" aria-disabled={!scene.value}>
        Export
      </summary>
      <section class="export-sheet card" aria-label="Export">
        {exporting.value.kind === 'idle' ? <Choices /> : <Course />}
      </section>
    </details>
  );
}

function Choices(): JSX.Element {
  return (
    <>
      {KINDS.map(({ kind, label, about, needs }) => (
        <button type="button" key={kind} class="export-choice" disabled={!scene.value || !needs.every(has)} onClick={() => prepare(kind)}>
          <strong>{label}</strong>
          <span>{about}</span>
        </button>
      ))}
      {!has('track') && <p class="export-note">Choose a track on the timeline to export motion.</p>}
      {has('track') && !has('words') && <p class="export-note">For captions, write what is said in the Speech panel.</p>}
      <label class="export-option">
        Video size
        <select
          class="select"
          value={videoSize.value}
          onChange={(event) => {
            videoSize.value = Number(event.currentTarget.value);
          }}
        >
          {VIDEO_SIZES.map((size) => (
            <option key={size} value={size}>
              {size} px
            </option>
          ))}
        </select>
      </label>
      <label class="export-option">
        Repeat animated SVG
        <input
          type="checkbox"
          checked={looped.value}
          onChange={(event) => {
            looped.value = event.currentTarget.checked;
          }}
        />
      </label>
    </>
  );
}

const has = (need: Need) => (need === 'track' ? track.value !== null : captions.value.length > 0);

/** What is under way or about to start. */
function Course(): JSX.Element | null {
  const now = exporting.value;
  if (now.kind === 'idle') return null;
  const label = KINDS.find(({ kind }) => kind === now.what)?.label;
  return (
    <div class="export-course" aria-live="polite">
      <strong>{label}</strong>
      {now.kind === 'measuring' && <p>Trying it out…</p>}
      {now.kind === 'ready' && (
        <>
          <p>{now.forecast ? forecastText(now.forecast) : 'This browser cannot encode it; the server will render it.'}</p>
          {now.inFull && <p class="export-note">Lighter, with fewer keyframes: in full it would be {sizeText(now.inFull.bytes)}.</p>}
          {now.note && <p class="export-note">{now.note}</p>}
          {now.forecast && now.forecast.bytes > LARGE_BYTES && (
            <p class="export-note">Large for the web: a shorter track or a video is lighter.</p>
          )}
        </>
      )}
      {now.kind === 'working' && <progress aria-label="Export progress" value={now.progress} max={1} />}
      <div class="row">
        {now.kind === 'ready' && (
          <Button emphasis="primary" onClick={() => start()}>
            Download
          </Button>
        )}
        {now.kind === 'ready' && canBeLighter(now) && <Button onClick={() => prepareLighter()}>Make it lighter</Button>}
        <Button onClick={cancel}>Cancel</Button>
      </div>
    </div>
  );
}

/** Animated SVG that is worth it, once. */
const canBeLighter = ({ what, forecast, inFull }: Exporting & { readonly kind: 'ready' }) =>
  (what === 'animated' || what === 'page') && !inFull && forecast !== null && forecast.bytes > HEAVY_BYTES;

/** Closes on Escape and on a press outside, unless something is being exported. */
function closeOnLeave(details: { readonly current: HTMLDetailsElement | null }): () => void {
  const close = (event: Event) => {
    const menu = details.current;
    if (!menu?.open || exporting.value.kind === 'working') return;
    const isEscape = event instanceof KeyboardEvent && event.key === 'Escape';
    const isOutside = event instanceof PointerEvent && event.target instanceof Node && !menu.contains(event.target);
    if (isEscape || isOutside) menu.open = false;
  };
  document.addEventListener('keydown', close);
  document.addEventListener('pointerdown', close);
  return () => {
    document.removeEventListener('keydown', close);
    document.removeEventListener('pointerdown', close);
  };
}
