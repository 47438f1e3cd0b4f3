/** "Which face should talk?": a box round every face that was found. */
import type { JSX } from 'preact';
import { chooseFace } from '../store/opening';
import { session } from '../store/state';
import { toScreen } from './view';
import { stageSize, view } from './viewState';

export function FaceBoxes(): JSX.Element | null {
  const now = session.value;
  if (now.kind !== 'choosing') return null;
  return (
    <fieldset class="face-boxes" aria-label="Which face should talk?">
      {now.faces.faces.map((face, index) => {
        const [left, top] = toScreen(view.value, stageSize.value, [face.box.x, face.box.y]);
        const { scale } = view.value;
        const style = { left: `${left}px`, top: `${top}px`, width: `${face.box.width * scale}px`, height: `${face.box.height * scale}px` };
        return (
          <button
            key={`${left},${top}`}
            type="button"
            class="face-box"
            data-own-pointer
            style={style}
            onClick={() => void chooseFace(face)}
          >
            <span>Face {index + 1}</span>
          </button>
        );
      })}
      <p class="card stage-question">Which face should talk?</p>
    </fieldset>
  );
}
