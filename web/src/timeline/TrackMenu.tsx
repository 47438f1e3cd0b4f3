/** Chooses what plays: the demo, the sample tracks, opened ones, or a file. */
import type { JSX } from 'preact';
import { Button } from '../shell/Button';
import { pickFile } from '../shell/pickFile';
import { report } from '../store/notices';
import { canPose, openedTracks, track } from '../store/state';
import { openSampleTrack, openTrackFile, useTrack } from '../store/tracks';
import { demoTrack } from './demo';
import { sampleTracks } from './samples';

const DEMO = 'demo';

export function TrackMenu(): JSX.Element {
  const samples = sampleTracks.value;
  const opened = openedTracks.value;
  return (
    <div class="track-menu row">
      <select
        class="select"
        aria-label="Track"
        disabled={!canPose.value}
        value={track.value ? `opened:${track.value.name}` : ''}
        onChange={(event) => choose(event.currentTarget.value)}
      >
        <option value="" disabled>
          Choose a track
        </option>
        <option value={DEMO}>Demo: blink, smile, speak, tilt</option>
        {samples.map(({ file, label }) => (
          <option key={file} value={`sample:${file}`}>
            {label}
          </option>
        ))}
        {opened.length > 0 && (
          <optgroup label="In this project">
            {opened.map(({ name }) => (
              <option key={name} value={`opened:${name}`}>
                {name}
              </option>
            ))}
          </optgroup>
        )}
      </select>
      <Button
        emphasis="quiet"
        disabled={!canPose.value}
        onClick={() => pickFile('.json,.csv', (file) => openTrackFile(file).catch(report))}
      >
        Open track…
      </Button>
    </div>
  );
}

function choose(value: string): void {
  if (value === DEMO) return useTrack(demoTrack());
  const [kind, name] = [value.slice(0, value.indexOf(':')), value.slice(value.indexOf(':') + 1)];
  if (kind === 'sample') openSampleTrack(name).catch(report);
  const opened = openedTracks.value.find((candidate) => candidate.name === name);
  if (kind === 'opened' && opened) useTrack(opened);
}
