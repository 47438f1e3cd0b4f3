/** Tracks from other programs, and for them. */
import type { JSX } from 'preact';
import { exportTrack, importTrack, type TrackFormat } from '../api/speech';
import { download } from '../project/files';
import { Button } from '../shell/Button';
import { pickFile } from '../shell/pickFile';
import { announce, report } from '../store/notices';
import { track } from '../store/state';
import { useTrack } from '../store/tracks';
import { audioOf, blocksOf, type SpeechTrack } from './speechTrack';

const TRACKS = '.json,.tsv,.csv,.txt';
const SAME_SECONDS = 0.5; // a track this near in length to the sound on the timeline was made for it

const FORMATS: readonly { readonly format: TrackFormat; readonly label: string; readonly ending: string; readonly ofBlocks: boolean }[] = [
  { format: 'json', label: 'VectorTalker JSON', ending: 'json', ofBlocks: false },
  { format: 'rhubarb-tsv', label: 'Rhubarb TSV', ending: 'tsv', ofBlocks: true },
  { format: 'rhubarb-json', label: 'Rhubarb JSON', ending: 'rhubarb.json', ofBlocks: true },
  { format: 'csv', label: 'CSV, 68 points a frame', ending: 'csv', ofBlocks: false },
];

export function TrackFiles({ disabled }: { readonly disabled: boolean }): JSX.Element {
  const hasBlocks = blocksOf(track.value) !== null;
  return (
    <section class="speech-section row" aria-label="Track files">
      <Button disabled={disabled} onClick={() => pickFile(TRACKS, (file) => readTrackFile(file).catch(report))}>
        Import a track…
      </Button>
      <select
        class="select"
        aria-label="Export the track"
        disabled={disabled || !track.value}
        value=""
        onChange={(event) => {
          const chosen = FORMATS.find(({ format }) => format === event.currentTarget.value);
          event.currentTarget.value = '';
          if (chosen) writeTrackFile(chosen.format, chosen.ending).catch(report);
        }}
      >
        <option value="" disabled>
          Export the track
        </option>
        {FORMATS.map(({ format, label, ofBlocks }) => (
          <option key={format} value={format} disabled={ofBlocks && !hasBlocks}>
            {label}
          </option>
        ))}
      </select>
    </section>
  );
}

/** An imported track speaks with the sound on the timeline if it was made for it. */
async function readTrackFile(file: File): Promise<void> {
  const before = track.value;
  const imported: SpeechTrack = await importTrack(file, file.name);
  const audio = audioOf(before);
  const isForSound = before !== null && audio !== null && Math.abs(before.duration - imported.duration) < SAME_SECONDS;
  useTrack(isForSound ? { ...imported, audio } : imported);
}

async function writeTrackFile(format: TrackFormat, ending: string): Promise<void> {
  const present = track.value;
  if (!present) return;
  const name = `${present.name}.${ending}`;
  download(await exportTrack(present, format), name);
  announce(`Exported ${name}`);
}
