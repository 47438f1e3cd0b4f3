/** Files that come from outside: dropped anywhere on the page, pasted, or picked. */

import { signal } from '@preact/signals';
import { openProjectFile } from '../project/files';
import { takeSound } from '../speech/listening';
import { isSound } from '../speech/soundFiles';
import { report, tell } from '../store/notices';
import { openPicture } from '../store/opening';
import { canPose, panel } from '../store/state';
import { openTrackFile } from '../store/tracks';

/** Whether a file hovers over the page. */
export const dragging = signal(false);

/** Portraits, projects, tracks and sounds, told apart by name; everything else is tried as a portrait. */
export function openFile(file: File): void {
  const isTrack = /\.(json|csv)$/i.test(file.name);
  if (/\.vtalk$/i.test(file.name)) openProjectFile(file).catch(report);
  else if (isTrack && canPose.value) openTrackFile(file).catch(report);
  else if (isSound(file)) openSound(file);
  else openPicture(file, file.name || 'Pasted picture').catch(report);
}

/** The portrait on the stage speaks it. */
function openSound(file: File): void {
  if (!canPose.value) return tell({ kind: 'advice', text: 'Open a portrait first; then drop the sound that it should speak.' });
  panel.value = 'speech';
  takeSound(file, file.name).catch(report);
}

export async function openSample(url: string, name: string): Promise<void> {
  const response = await fetch(url);
  await openPicture(await response.blob(), name);
}

/** Reads a picture from the clipboard, where the browser allows it. */
export async function openClipboard(): Promise<boolean> {
  for (const item of await navigator.clipboard.read()) {
    const type = item.types.find((candidate) => candidate.startsWith('image/'));
    if (!type) continue;
    openFile(new File([await item.getType(type)], 'Pasted picture', { type }));
    return true;
  }
  return false;
}

/** Listens to the whole page until the returned function is called. */
export function listenToDrops(): () => void {
  const over = (event: DragEvent) => {
    event.preventDefault();
    dragging.value = true;
  };
  const leave = (event: DragEvent) => {
    if (!event.relatedTarget) dragging.value = false;
  };
  const drop = (event: DragEvent) => {
    event.preventDefault();
    dragging.value = false;
    const [file] = event.dataTransfer?.files ?? [];
    if (file) openFile(file);
  };
  const paste = (event: ClipboardEvent) => {
    const [file] = event.clipboardData?.files ?? [];
    if (file) openFile(file);
  };
  window.addEventListener('dragover', over);
  window.addEventListener('dragleave', leave);
  window.addEventListener('drop', drop);
  window.addEventListener('paste', paste);
  return () => {
    window.removeEventListener('dragover', over);
    window.removeEventListener('dragleave', leave);
    window.removeEventListener('drop', drop);
    window.removeEventListener('paste', paste);
  };
}
