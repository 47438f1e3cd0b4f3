/** What the camera sees, as in a mirror, and the button that keeps it. */
import { useSignal } from '@preact/signals';
import type { JSX } from 'preact';
import { useEffect, useRef } from 'preact/hooks';
import { Button } from '../shell/Button';
import { report } from '../store/notices';
import { camera, stopCamera, takePicture } from './camera';

export function CameraView(): JSX.Element {
  const video = useRef<HTMLVideoElement>(null);
  const isLive = useSignal(false);
  const now = camera.value;
  const stream = now.kind === 'seeing' ? now.stream : null;
  useEffect(() => stopCamera, []);
  useEffect(() => {
    if (video.current) video.current.srcObject = stream;
  }, [stream]);
  const take = () => {
    if (video.current) takePicture(video.current).catch(report);
  };
  return (
    <div class="camera">
      <video
        ref={video}
        autoplay
        muted
        playsinline
        aria-label="What the camera sees"
        onPlaying={() => {
          isLive.value = true;
        }}
      />
      {!stream && <p role="status">Waiting for the camera: allow it in the browser’s question.</p>}
      <div class="row">
        <Button emphasis="primary" disabled={!isLive.value} onClick={take}>
          Take the picture
        </Button>
        <Button onClick={stopCamera}>Cancel</Button>
      </div>
    </div>
  );
}
