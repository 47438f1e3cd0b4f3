/** The first screen: a talking example, one sentence, one place to put a portrait, six samples, and what happens to the picture. */
import type { JSX } from 'preact';
import { DetailChoice, detailMeaning } from '../panels/DetailChoice';
import { Button } from '../shell/Button';
import { Icon } from '../shell/icons';
import { PICTURES, pickFile } from '../shell/pickFile';
import { useObjectUrl } from '../shell/useObjectUrl';
import { report, tell } from '../store/notices';
import { returnToPortrait } from '../store/opening';
import { documentName, portrait, preset, session } from '../store/state';
import { CameraView } from './CameraView';
import { camera, startCamera } from './camera';
import { dragging, openClipboard, openFile, openSample } from './incoming';
import { type Sample, samples } from './samples';

export function Welcome(): JSX.Element {
  return (
    <main class="welcome">
      <header class="welcome-head">
        <Example />
        <div>
          <h1>A portrait becomes a layered SVG that talks.</h1>
          <p class="lead">
            Photo, painting, manga, cartoon: it is redrawn as a few hundred vector shapes that you pose by hand, play and export.
          </p>
        </div>
      </header>
      <Return />
      <DropZone />
      <Samples />
      <p class="quiet small-print">
        The picture goes to the VectorTalker server at {location.host} and nowhere else; it stays in that server’s data folder. Your work is
        kept in this browser. No account.
      </p>
    </main>
  );
}

/** What comes out, before anything is asked of people: it talks without sound, and keeps still where they prefer that. */
function Example(): JSX.Element {
  return (
    <picture class="example">
      <source media="(prefers-reduced-motion: reduce)" srcset="examples/mona-lisa.svg" />
      <img src="examples/mona-lisa-talking.svg" width={148} height={148} alt="Example: a painting, redrawn in 150 vector shapes, talks" />
    </picture>
  );
}

/** The portrait that was left for the first screen. */
function Return(): JSX.Element | null {
  const picture = useObjectUrl(portrait.value?.picture ?? null);
  const now = session.value;
  if (now.kind !== 'welcome' || !now.behind) return null;
  return (
    <button type="button" class="button return" onClick={returnToPortrait}>
      {picture && <img src={picture} alt="" />}
      Go on with “{documentName.value}”
    </button>
  );
}

function DropZone(): JSX.Element {
  const isCameraOn = camera.value.kind === 'asking' || camera.value.kind === 'seeing';
  return (
    <section class={dragging.value ? 'drop-zone over' : 'drop-zone'} aria-label="Open a portrait">
      {isCameraOn ? <CameraView /> : <Ways />}
      <DetailChoice />
      <p class="quiet">{detailMeaning(preset.value)} · PNG, JPEG, WebP, GIF, BMP or TIFF, up to 25 MB</p>
    </section>
  );
}

/** The ways by which a picture gets here. */
function Ways(): JSX.Element {
  const now = camera.value;
  return (
    <>
      <Icon name="picture" />
      <p class="drop-title">{dragging.value ? 'Let go to open it' : 'Drop a portrait here'}</p>
      <div class="row">
        <Button emphasis="primary" onClick={() => pickFile(PICTURES, openFile)}>
          Choose a file
        </Button>
        <Button onClick={() => void paste()}>Paste</Button>
        <Button onClick={() => startCamera().catch(report)}>Use the camera</Button>
      </div>
      {now.kind === 'refused' && <p role="alert">{now.reason}</p>}
    </>
  );
}

async function paste(): Promise<void> {
  const found = await openClipboard().catch(() => false);
  if (!found) tell({ kind: 'advice', text: 'The clipboard shows no picture to this button. Copy one and press Ctrl V.' });
}

function Samples(): JSX.Element | null {
  if (samples.value.length === 0) return null;
  return (
    <section class="samples" aria-label="Samples">
      <h2>Or start with one of these</h2>
      <ul>
        {samples.value.map((sample) => (
          <li key={sample.file}>
            <SampleCard sample={sample} />
          </li>
        ))}
      </ul>
    </section>
  );
}

function SampleCard({ sample: { file, name, style, credit, licence } }: { readonly sample: Sample }): JSX.Element {
  const url = `samples/${file}`;
  return (
    <button type="button" class="sample" title={`${credit}. ${licence}`} onClick={() => openSample(url, file).catch(report)}>
      <img src={url} alt="" loading="lazy" />
      <span>
        <strong>{name}</strong>
        <span class="quiet">{style}</span>
      </span>
    </button>
  );
}
