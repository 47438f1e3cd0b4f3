/** Saves the open work as a `.vtalk` file and opens one. */
import type { Project, Track } from '../api/schema';
import { clipsOf } from '../speech/clips';
import { audioOf } from '../speech/speechTrack';
import { type Edit, editOf, LAYER_NAMES, type LayerLook, type LayerName } from '../store/edit';
import { historyOf } from '../store/history';
import { announce, FileError } from '../store/notices';
import { tellReplaced } from '../store/opening';
import { putAside } from '../store/replacing';
import { clearStage, putOnStage } from '../store/stage';
import { history, portrait, scene, session } from '../store/state';
import { withKeysBaked, withKeysLifted } from '../timeline/bakedKeys';
import { pause } from '../timeline/playback';
import { pack, unpack } from './vtalk';

export async function saveProject(): Promise<void> {
  const project = projectOf();
  const picture = portrait.value?.picture ?? null;
  const source = picture && project.source ? new Uint8Array(await picture.arrayBuffer()) : null;
  const data = await pack({ project, source, sounds: await soundsOf(history.value.present) });
  download(new Blob([data as Uint8Array<ArrayBuffer>], { type: 'application/zip' }), `${project.name}.vtalk`);
  announce(`Saved ${project.name}.vtalk`);
}

export async function openProjectFile(file: File): Promise<void> {
  const { project, source, sounds } = await unpack(new Uint8Array(await file.arrayBuffer()), file.name);
  const { width, height } = project.scene;
  const picture = source ? new Blob([source as Uint8Array<ArrayBuffer>]) : null;
  const isInSight = session.value.kind !== 'welcome';
  pause();
  const aside = putAside();
  clearStage();
  putOnStage({
    session: { kind: 'editing' },
    portrait: { id: null, name: project.source ?? file.name, width, height, picture, notices: [] },
    scene: project.scene,
    history: historyOf(editFrom(project)),
    job: { state: null, landmarks: project.landmarks },
    clips: Array.from(sounds, ([name, data]) => ({ id: null, name, data: new Blob([data as Uint8Array<ArrayBuffer>]) })),
  });
  if (aside && isInSight) tellReplaced(aside);
}

/** The open work as a project document. */
export function projectOf(): Project {
  const open = scene.value;
  if (!open) throw new FileError('There is no vector picture to save yet.');
  const { name, landmarks, pose, tracks, layers } = history.value.present;
  const source = portrait.value?.picture ? `source.${endingOf(portrait.value.picture)}` : null;
  const audio = clipsOf(history.value.present)[0]?.name ?? null;
  return {
    schema_version: 1,
    name,
    scene: open,
    landmarks,
    pose,
    tracks: tracks.map(withKeysBaked),
    settings: settingsOf(layers),
    source,
    audio,
  };
}

async function soundsOf(edit: Edit): Promise<Map<string, Uint8Array>> {
  const read = clipsOf(edit).map(async ({ name, data }) => [name, new Uint8Array(await data.arrayBuffer())] as const);
  return new Map(await Promise.all(read));
}

function editFrom({ name, landmarks, pose, tracks, settings, audio }: Project): Edit {
  const plain = editOf(name, landmarks);
  const layers = Object.fromEntries(LAYER_NAMES.map((layer) => [layer, lookFrom(settings, layer, plain.layers[layer])])) as Record<
    LayerName,
    LayerLook
  >;
  const lifted = tracks.map(withKeysLifted);
  return { ...plain, pose, tracks: audio ? speakingWith(audio, lifted) : lifted, layers };
}

/** Other programs name the sound of the project only: it is that of the track on the timeline. */
function speakingWith(audio: string, tracks: readonly Track[]): Track[] {
  const isNamed = tracks.some((track) => audioOf(track) !== null);
  return tracks.map((track, place) => (isNamed || place > 0 ? track : { ...track, audio }));
}

/** Layer looks as flat settings: `back_visible`, `back_opacity`, … */
function settingsOf(layers: Edit['layers']): Project['settings'] {
  return Object.fromEntries(
    LAYER_NAMES.flatMap((name) => [
      [`${name}_visible`, layers[name].visible],
      [`${name}_opacity`, layers[name].opacity],
    ]),
  );
}

function lookFrom(settings: Project['settings'], name: LayerName, plain: LayerLook): LayerLook {
  const visible = settings[`${name}_visible`];
  const opacity = settings[`${name}_opacity`];
  return {
    visible: typeof visible === 'boolean' ? visible : plain.visible,
    opacity: typeof opacity === 'number' ? Math.min(1, Math.max(0, opacity)) : plain.opacity,
  };
}

const ENDINGS: Readonly<Record<string, string>> = {
  'image/jpeg': 'jpg',
  'image/webp': 'webp',
  'image/gif': 'gif',
  'image/bmp': 'bmp',
  'image/tiff': 'tiff',
};
const endingOf = (picture: Blob) => ENDINGS[picture.type] ?? 'png';

/** Hands a file to the browser's downloads. */
export function download(data: Blob, name: string): void {
  const url = URL.createObjectURL(data);
  const link = document.createElement('a');
  link.href = url;
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(url), 60_000); // the download reads it after the click
}
