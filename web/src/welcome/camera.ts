/** The camera of the device: off, asked for, refused, or seen; a still of it becomes a portrait. */
import { signal } from '@preact/signals';
import { FileError, report } from '../store/notices';
import { openPicture } from '../store/opening';

export type Camera =
  | { readonly kind: 'off' }
  | { readonly kind: 'asking' }
  | { readonly kind: 'refused'; readonly reason: string }
  | { readonly kind: 'seeing'; readonly stream: MediaStream };

export const camera = signal<Camera>({ kind: 'off' });

const WANTED: MediaTrackConstraints = { facingMode: 'user', width: { ideal: 1280 }, height: { ideal: 960 } };
const REASONS: Readonly<Record<string, string>> = {
  NotAllowedError: 'The browser may not use the camera. Allow it beside the address of this page, then try again.',
  NotFoundError: 'No camera was found. Plug one in and try again, or choose a file.',
  NotReadableError: 'Another program holds the camera. Close it, then try again.',
};

export async function startCamera(): Promise<void> {
  camera.value = { kind: 'asking' };
  try {
    if (!navigator.mediaDevices)
      throw new FileError('Browsers show the camera to secure pages only: open the editor by https, or on its own computer.');
    see(await navigator.mediaDevices.getUserMedia({ video: WANTED }));
  } catch (error) {
    const reason = error instanceof DOMException ? REASONS[error.name] : undefined;
    camera.value = reason ? { kind: 'refused', reason } : { kind: 'off' };
    if (!reason) report(error);
  }
}

/** The browser may answer after somebody changed their mind. */
function see(stream: MediaStream): void {
  if (camera.value.kind === 'asking') camera.value = { kind: 'seeing', stream };
  else stop(stream);
}

/** Why it was refused stays. */
export function stopCamera(): void {
  const now = camera.value;
  if (now.kind === 'seeing') stop(now.stream);
  if (now.kind !== 'refused') camera.value = { kind: 'off' };
}

/** What `video` shows becomes the portrait; the camera is off then. */
export async function takePicture(video: HTMLVideoElement): Promise<void> {
  const sheet = new OffscreenCanvas(video.videoWidth, video.videoHeight);
  const context = sheet.getContext('2d');
  if (!context) throw new Error('This browser gives no 2D canvas.');
  context.drawImage(video, 0, 0);
  stopCamera();
  await openPicture(await sheet.convertToBlob({ type: 'image/png' }), 'Camera picture.png');
}

function stop(stream: MediaStream): void {
  for (const track of stream.getTracks()) track.stop();
}
