/** Eyes and mouth of the portrait, enlarged, while its landmarks are corrected: a drag there is finer than on the whole face. */
import { useComputed, useSignal } from '@preact/signals';
import type { JSX } from 'preact';
import { type GroupName, groupNamed, indicesOf } from '../face/ibug';
import { subtract, type Xy } from '../face/vector';
import { useObjectUrl } from '../shell/useObjectUrl';
import type { Edit } from '../store/edit';
import { discard, settle, sketch } from '../store/editing';
import { edit, history, portrait, session, tool } from '../store/state';
import { type Held, heldWith } from './held';
import { INSET, insetBox } from './insetBox';
import { REACH } from './reach';
import { correctIris, correctLandmark } from './tools/restTool';

type Inset = { readonly label: string; readonly groups: readonly GroupName[]; readonly iris: 0 | 1 | null };

const INSETS: readonly Inset[] = [
  { label: 'Left eye', groups: ['left_eye'], iris: 0 },
  { label: 'Right eye', groups: ['right_eye'], iris: 1 },
  { label: 'Mouth', groups: ['outer_lips', 'inner_lips'], iris: null },
];

export function Insets(): JSX.Element | null {
  const picture = useObjectUrl(portrait.value?.picture ?? null);
  const isCorrecting = useComputed(
    () => tool.value === 'rest' && session.value.kind === 'editing' && history.value.present.landmarks !== null,
  ).value;
  if (!isCorrecting || !picture) return null;
  return (
    <div class="insets" data-own-pointer>
      {INSETS.map((inset) => (
        <Enlarged key={inset.label} inset={inset} picture={picture} />
      ))}
    </div>
  );
}

function Enlarged({ inset: { label, groups, iris }, picture }: { readonly inset: Inset; readonly picture: string }): JSX.Element | null {
  const settled = history.value.present.landmarks; // what is shown stays while a point in it is dragged
  const landmarks = edit.value.landmarks;
  const size = portrait.value;
  if (!settled || !landmarks || !size) return null;
  const outlines = groups.map((name) => indicesOf(groupNamed(name)));
  const box = insetBox(outlines.flat().map((index) => settled.points[index]));
  const unit = box.width / INSET.width; // portrait pixels per screen pixel
  const centre = iris === null ? undefined : landmarks.irises?.[iris].centre;
  return (
    <svg
      class="inset card"
      role="img"
      aria-label={`${label}, enlarged`}
      viewBox={`${box.x} ${box.y} ${box.width} ${box.height}`}
      style={{ '--unit': `${unit}px` }}
      {...INSET}
    >
      <image href={picture} width={size.width} height={size.height} preserveAspectRatio="none" />
      {outlines.map((indices) => (
        <polygon key={indices[0]} points={indices.map((index) => landmarks.points[index].join()).join(' ')} />
      ))}
      {outlines.flat().map((index) => (
        <Point
          key={index}
          at={landmarks.points[index]}
          correct={(start, moved, held) => correctLandmark(start, index, moved, held, REACH)}
        />
      ))}
      {centre && iris !== null && <Point at={centre} correct={(start, moved) => correctIris(start, iris, moved)} />}
    </svg>
  );
}

type PointProps = { readonly at: Xy; readonly correct: (start: Edit, moved: Xy, held: Held) => Edit };

/** A point that is dragged; the keyboard has its twin on the stage. */
function Point({ at, correct }: PointProps): JSX.Element {
  const from = useSignal<Xy | null>(null);
  const press = (event: PointerEvent & { currentTarget: SVGCircleElement }) => {
    event.currentTarget.setPointerCapture(event.pointerId);
    from.value = portraitPoint(event);
  };
  const drag = (event: PointerEvent & { currentTarget: SVGCircleElement }) => {
    if (from.value) sketch(correct(history.value.present, subtract(portraitPoint(event), from.value), heldWith(event)));
  };
  const end = (finish: () => void) => () => {
    from.value = null;
    finish();
  };
  return (
    <circle cx={at[0]} cy={at[1]} onPointerDown={press} onPointerMove={drag} onPointerUp={end(settle)} onPointerCancel={end(discard)} />
  );
}

function portraitPoint(event: PointerEvent & { currentTarget: SVGCircleElement }): Xy {
  const toScreen = event.currentTarget.getScreenCTM();
  const { x, y } = new DOMPoint(event.clientX, event.clientY).matrixTransform(toScreen?.inverse());
  return [x, y];
}
