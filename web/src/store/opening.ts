/** Actions that bring a portrait onto the stage: picture, faces, landmarks, job. */
import { getFaces, getPortraitImage, postPortrait } from '../api/client';
import { hasEnded } from '../api/events';
import type { Face, Landmarks, Portrait } from '../api/schema';
import { groupNamed, indicesOf, MOUTH_CORNERS, NOSE_TIP } from '../face/ibug';
import { centroid } from '../face/vector';
import { editOf, withLandmarks } from './edit';
import { apply } from './editing';
import { historyOf } from './history';
import { announce, dismiss, report, tell } from './notices';
import { bringBack, bringNearest, putAside } from './replacing';
import { clearStage, emptyStage, openingSignal, startOpening } from './stage';
import {
  edit,
  history,
  type Pins,
  type PortraitWork,
  playing,
  portrait,
  type Session,
  scene,
  session,
  tool,
  type Uploading,
} from './state';
import { startTracing } from './tracing';

/** From a picture to a running job. A newer picture takes over from one that is still being opened; a refused one leaves all as it was. */
export async function openPicture(picture: Blob, name: string): Promise<void> {
  const signal = startOpening();
  const before = session.value.kind === 'uploading' ? session.value.before : session.value;
  playing.value = false;
  dismiss();
  session.value = { kind: 'uploading', name, picture, before };
  const posted = await postPortrait(picture, name, signal).catch((error: unknown) => {
    if (signal.aborted) return null;
    session.value = before;
    report(error);
    if (before.kind === 'finding') void resumeOpening();
    return null;
  });
  if (posted) await openPosted(posted, picture, before, signal);
}

async function openPosted(posted: Portrait, picture: Blob, before: Session, signal: AbortSignal): Promise<void> {
  const aside = putAside();
  emptyStage();
  if (aside && before.kind !== 'welcome') tellReplaced(aside);
  show(posted, picture);
  replaceByNormalised(posted, signal).catch(report);
  try {
    await findFaces(posted, signal);
  } catch (error) {
    if (signal.aborted) return;
    session.value = { kind: 'editing' };
    report(error);
  }
}

/** Goes on where a reload came before the tracing: sends the picture again, looks for the face, or traces. */
export async function resumeOpening(): Promise<void> {
  const now = session.value;
  if (now.kind === 'uploading') return openPicture(now.picture, now.name);
  const open = portrait.value;
  if (!open || scene.value || (now.kind !== 'finding' && now.kind !== 'editing')) return;
  if (edit.value.landmarks) return startTracing();
  if (open.id === null) return startPinning(true);
  session.value = { kind: 'finding' };
  const signal = openingSignal();
  try {
    await findFaces({ ...open, id: open.id }, signal);
  } catch (error) {
    if (signal.aborted) return;
    session.value = { kind: 'editing' };
    report(error, { label: 'Try again', run: () => void resumeOpening() });
  }
}

/** For who saw the portrait go, and may not have meant it. */
export function tellReplaced({ history: { present } }: PortraitWork): void {
  tell({
    kind: 'done',
    text: `“${present.name}” gave way to this portrait.`,
    action: { label: 'Bring it back', run: () => goOnWith(bringBack()) },
  });
}

/** Goes on with a portrait that has come back to the stage. */
export function goOnWith(work: PortraitWork | null): void {
  if (!work) return;
  announce(`Back to ${work.history.present.name}`);
  resumeWork(work);
}

/** Goes on with what was under way on a portrait when it gave way; its tracing was stopped then, and starts anew. */
function resumeWork({ job: { state } }: PortraitWork): void {
  if (!state) void resumeOpening();
  else if (!hasEnded(state)) void startTracing();
}

/** To the first screen, from where `returnToPortrait` leads back; what is only on its way to the stage is dropped. */
export function leavePortrait(): void {
  const now = session.value;
  if (now.kind === 'welcome') return;
  if (now.kind === 'finding') return closePortrait();
  if (now.kind === 'uploading') {
    stopSending(now);
    return leavePortrait();
  }
  playing.value = false;
  dismiss();
  session.value = { kind: 'welcome', behind: now };
}

/** Back to what was there before a picture was sent. */
export function stopSending({ before }: Uploading): void {
  startOpening();
  session.value = before;
  if (before.kind === 'finding') void resumeOpening();
}

export function returnToPortrait(): void {
  if (session.value.kind === 'welcome' && session.value.behind) session.value = session.value.behind;
}

/** To the first screen, without the portrait on the stage. One that gave way to it waits there in its place. */
export function closePortrait(): void {
  clearStage();
  const nearest = bringNearest();
  session.value = { kind: 'welcome', behind: nearest?.session ?? null };
  if (nearest) resumeWork(nearest);
}

/** One of several faces was picked. */
export async function chooseFace(face: Face): Promise<void> {
  await useFace(face);
}

/** The fitted pins became landmarks, or null: the picture is traced without a face. */
export async function useFit(landmarks: Landmarks | null): Promise<void> {
  const isFirst = scene.value === null;
  session.value = { kind: 'editing' };
  dismiss();
  if (isFirst) history.value = historyOf(withLandmarks(edit.value, landmarks));
  else apply((present) => withLandmarks(present, landmarks));
  if (isFirst) await startTracing();
}

/** Lays five pins on the portrait, where its landmarks are or to be dragged onto the face. */
export function startPinning(noFaceFound: boolean): void {
  const open = portrait.value;
  if (!open) return;
  const { landmarks } = edit.value;
  session.value = { kind: 'pinning', pins: landmarks ? pinsOf(landmarks) : middlePins(open.width, open.height), noFaceFound };
}

export function movePin(index: number, x: number, y: number): void {
  const now = session.value;
  if (now.kind !== 'pinning') return;
  const pins = now.pins.map((pin, k) => (k === index ? [x, y] : pin)) as unknown as Pins; // map forgets the length of a tuple
  session.value = { ...now, pins };
}

/** Leaves the pins of a portrait that is traced already. */
export function stopPinning(): void {
  session.value = { kind: 'editing' };
}

function show(posted: Portrait, picture: Blob): void {
  portrait.value = { ...posted, picture };
  history.value = historyOf(editOf(nameWithoutEnding(posted.name), null));
  session.value = { kind: 'finding' };
  tool.value = 'pose';
  if (posted.notices.length > 0) tell({ kind: 'advice', text: posted.notices.join(' ') });
}

/** The server's picture has its turn and colours put right, and opens where the browser cannot read the original. */
async function replaceByNormalised(posted: Portrait, signal: AbortSignal): Promise<void> {
  const picture = await getPortraitImage(posted.id, signal);
  if (portrait.value?.id === posted.id) portrait.value = { ...portrait.value, picture };
}

type SentPortrait = Pick<Portrait, 'id' | 'width' | 'height'>;

async function findFaces(sent: SentPortrait, signal: AbortSignal): Promise<void> {
  const { faces } = await getFaces(sent.id, signal);
  await takeFaces(faces, sent);
}

async function takeFaces(faces: readonly Face[], posted: SentPortrait): Promise<void> {
  if (faces.length === 0) {
    announce('No face found. Put the five pins on the eyes, the tip of the nose and the mouth corners.');
    startPinning(true);
  } else if (faces.length > 1) {
    announce('Which face should talk?');
    session.value = { kind: 'choosing', faces: { width: posted.width, height: posted.height, faces: [...faces] } };
  } else await useFace(faces[0]);
}

async function useFace(face: Face): Promise<void> {
  session.value = { kind: 'editing' };
  history.value = historyOf(withLandmarks(edit.value, face.landmarks));
  if (face.fit_advised) adviseFit();
  await startTracing();
}

function adviseFit(): void {
  tool.value = 'rest';
  tell({
    kind: 'advice',
    text: 'Check the landmarks: the fit is doubtful. Drag points onto the eyes and the mouth.',
    action: { label: 'Use five pins', run: () => startPinning(false) },
  });
}

/** Pins where a face mostly is: in the upper middle, a third of the shorter side wide. */
function middlePins(width: number, height: number): Pins {
  const unit = Math.min(width, height);
  const at = (x: number, y: number): [number, number] => [width / 2 + x * unit, height * 0.45 + y * unit];
  return [at(-0.11, -0.08), at(0.11, -0.08), at(0, 0.03), at(-0.08, 0.13), at(0.08, 0.13)];
}

function pinsOf({ points }: Landmarks): Pins {
  const [left, right] = [groupNamed('left_eye'), groupNamed('right_eye')].map((eye) =>
    centroid(indicesOf(eye).map((index) => points[index])),
  );
  return [left, right, points[NOSE_TIP], points[MOUTH_CORNERS[0]], points[MOUTH_CORNERS[1]]];
}

const nameWithoutEnding = (name: string) => name.replace(/\.[^.]{1,5}$/, '');

export function rename(name: string): void {
  const trimmed = name.trim();
  if (trimmed) apply((present) => (present.name === trimmed ? present : { ...present, name: trimmed }));
}
