/** Deletes a portrait and its recordings for good: in the browser first, then on the server. */
import { deletePortrait, RequestError } from '../api/client';
import { deleteRecording } from '../api/speech';
import { announce, report, tell } from '../store/notices';
import { closePortrait } from '../store/opening';
import { clips, edit, portrait } from '../store/state';
import { workKept } from './autosave';

/** Asks before it deletes: unlike everything else in the editor, this cannot be undone. */
export function offerDeletion(): void {
  const open = portrait.value;
  if (!open) return;
  const recordingIds = clips.value.flatMap(({ id }) => id ?? []);
  tell({
    kind: 'advice',
    text: `Delete “${edit.value.name}” for good, here and on the server?`,
    action: { label: 'Delete', run: () => void deleteForGood(open.id, recordingIds) },
  });
}

async function deleteForGood(portraitId: string | null, recordingIds: readonly string[]): Promise<void> {
  closePortrait();
  await deleteStored(portraitId, recordingIds);
}

async function deleteStored(portraitId: string | null, recordingIds: readonly string[]): Promise<void> {
  try {
    await workKept();
    await Promise.all([...(portraitId ? [deletePortrait(portraitId)] : []), ...recordingIds.map(deleteRecording)].map(unlessGone));
    announce('Deleted');
  } catch (error) {
    report(error, { label: 'Try again', run: () => void deleteStored(portraitId, recordingIds) });
  }
}

/** What the server has dropped by itself needs no deleting. */
async function unlessGone(deletion: Promise<void>): Promise<void> {
  await deletion.catch((error: unknown) => {
    if (!(error instanceof RequestError && error.code === 'not_found')) throw error;
  });
}
