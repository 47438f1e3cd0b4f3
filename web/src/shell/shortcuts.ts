/** Every keyboard shortcut: one table for the keys and for the sheet that lists them. */
import { saveProject } from '../project/files';
import { panning } from '../stage/toolInHand';
import { actualSize, fitToStage, zoomStep } from '../stage/viewState';
import { atRest, isAtRest, LAYER_NAMES, withLayer } from '../store/edit';
import { apply } from '../store/editing';
import { growSoftRadius, takeTool, toggle } from '../store/looking';
import { report } from '../store/notices';
import {
  canPose,
  captionsShown,
  comparing,
  edit,
  ghostShown,
  landmarksShown,
  looping,
  meshShown,
  mirrored,
  panel,
  scene,
  session,
  shortcutsShown,
  singlePoint,
  track,
} from '../store/state';
import { redoStep, undoStep } from '../store/steps';
import { insertKeyframe } from '../store/tracks';
import { rewind, seek, stepFrames, togglePlaying } from '../timeline/playback';

export type Shortcut = {
  /** Key combination as `combinationOf` writes it; several do the same. */
  readonly keys: readonly string[];
  /** As the sheet writes it, where that differs. */
  readonly shown?: string;
  readonly label: string;
  readonly run: () => void;
};

export type ShortcutGroup = { readonly label: string; readonly shortcuts: readonly Shortcut[] };

const PANELS = ['layers', 'pose', 'speech'] as const;

const LAYER_KEYS = [...LAYER_NAMES].reverse().map(
  (name, index): Shortcut => ({
    keys: [`${index + 1}`],
    label: `Show or hide ${name}`,
    run: () => apply((present) => withLayer(present, name, { ...present.layers[name], visible: !present.layers[name].visible })),
  }),
);

export const SHORTCUT_GROUPS: readonly ShortcutGroup[] = [
  {
    label: 'Tools',
    shortcuts: [
      { keys: ['v'], label: 'Pose', run: () => takeTool('pose') },
      { keys: ['a'], label: 'Adjust the landmarks', run: () => takeTool('rest') },
      { keys: ['h'], label: 'Pan', run: () => takeTool('pan') },
      { keys: ['z'], label: 'Zoom', run: () => takeTool('zoom') },
      { keys: ['['], label: 'Shorter reach', run: () => growSoftRadius(-1) },
      { keys: [']'], label: 'Longer reach', run: () => growSoftRadius(1) },
      { keys: ['s'], label: 'Single point', run: () => toggle(singlePoint) },
      { keys: ['m'], label: 'Mirrored', run: () => toggle(mirrored) },
      { keys: ['0'], label: 'Reset the pose', run: () => !isAtRest(edit.value.pose) && apply(atRest) },
    ],
  },
  {
    label: 'Edit',
    shortcuts: [
      { keys: ['mod+z'], label: 'Undo', run: undoStep },
      { keys: ['mod+shift+z', 'mod+y'], label: 'Redo', run: redoStep },
      { keys: ['mod+s'], label: 'Save the project', run: () => scene.value && saveProject().catch(report) },
    ],
  },
  {
    label: 'View',
    shortcuts: [
      { keys: ['+', '='], label: 'Zoom in', run: () => zoomStep(1) },
      { keys: ['-'], label: 'Zoom out', run: () => zoomStep(-1) },
      { keys: ['f'], label: 'Fit to the stage', run: fitToStage },
      { keys: ['shift+f'], label: 'Actual size', run: actualSize },
      { keys: ['l'], label: 'Landmarks', run: () => toggle(landmarksShown) },
      { keys: ['t'], label: 'Mesh', run: () => toggle(meshShown) },
      { keys: ['g'], label: 'Ghost of the rest pose', run: () => toggle(ghostShown) },
      { keys: ['c'], label: 'Compare with the portrait', run: () => toggle(comparing) },
      ...LAYER_KEYS,
      {
        keys: ['p'],
        label: 'Next panel',
        run: () => {
          panel.value = PANELS[(PANELS.indexOf(panel.value) + 1) % PANELS.length];
        },
      },
    ],
  },
  {
    label: 'Timeline',
    shortcuts: [
      {
        keys: [' ', 'k'],
        shown: 'Space or K',
        label: 'Play, pause (hold Space and drag to pan)',
        run: () => canPose.value && togglePlaying(),
      },
      { keys: ['arrowleft'], shown: '←', label: 'One frame back', run: () => stepFrames(-1) },
      { keys: ['arrowright'], shown: '→', label: 'One frame on', run: () => stepFrames(1) },
      { keys: ['shift+arrowleft', 'j'], shown: 'Shift ← or J', label: 'Ten frames back', run: () => stepFrames(-10) },
      { keys: ['shift+arrowright'], shown: 'Shift →', label: 'Ten frames on', run: () => stepFrames(10) },
      { keys: ['home'], label: 'Back to the start', run: rewind },
      { keys: ['end'], label: 'To the end', run: () => seek(track.value?.duration ?? 0) },
      { keys: ['i'], label: 'Keyframe of the pose at the playhead', run: insertKeyframe },
      { keys: ['w'], label: 'Captions', run: () => toggle(captionsShown) },
      { keys: ['o'], label: 'Loop', run: () => toggle(looping) },
    ],
  },
  {
    label: 'Help',
    shortcuts: [{ keys: ['?', 'shift+?'], shown: '?', label: 'This sheet', run: () => toggle(shortcutsShown) }],
  },
];

/** What works on a focused landmark; listed in the sheet, handled where the landmarks are. */
export const LANDMARK_KEYS: readonly (readonly [string, string])[] = [
  ['Tab', 'Next group of landmarks'],
  ['Page Up, Page Down', 'Other landmarks of the group'],
  ['Arrows', 'Nudge by half a pixel, with Shift by 5'],
  ['Pen', 'A harder press reaches farther'],
  ['Delete', 'Back to rest'],
  ['Esc', 'Cancel a drag'],
];

const BY_KEYS = new Map(
  SHORTCUT_GROUPS.flatMap(({ shortcuts }) => shortcuts.flatMap((shortcut) => shortcut.keys.map((keys) => [keys, shortcut] as const))),
);

/** Listens to the whole page until the returned function is called. */
export function listenToShortcuts(): () => void {
  let spaceDrag = false;
  const down = (event: KeyboardEvent) => {
    if (isTyping(event.target) || event.altKey || (isStageCovered() && event.key !== '?')) return;
    const keys = combinationOf(event);
    if (keys === ' ') {
      if (isButton(event.target)) return;
      event.preventDefault();
      panning.value = true;
      return;
    }
    const shortcut = BY_KEYS.get(keys);
    if (!shortcut || (isSlider(event.target) && keys.includes('arrow'))) return;
    event.preventDefault();
    shortcut.run();
  };
  const up = (event: KeyboardEvent) => {
    if (event.key !== ' ' || !panning.value) return;
    panning.value = false;
    if (!spaceDrag) BY_KEYS.get(' ')?.run();
    spaceDrag = false;
  };
  const press = () => {
    spaceDrag = panning.value;
  };
  const release = () => {
    panning.value = false;
  };
  window.addEventListener('keydown', down);
  window.addEventListener('keyup', up);
  window.addEventListener('pointerdown', press);
  window.addEventListener('blur', release);
  return () => {
    window.removeEventListener('keydown', down);
    window.removeEventListener('keyup', up);
    window.removeEventListener('pointerdown', press);
    window.removeEventListener('blur', release);
  };
}

/** "mod+shift+z"; `mod` is Ctrl or Cmd. */
export function combinationOf(event: Pick<KeyboardEvent, 'key' | 'ctrlKey' | 'metaKey' | 'shiftKey'>): string {
  const key = event.key.toLowerCase();
  const isShifted = event.shiftKey && (key.length > 1 || /[a-z]/.test(key));
  return `${event.ctrlKey || event.metaKey ? 'mod+' : ''}${isShifted ? 'shift+' : ''}${key}`;
}

const isStageCovered = () => session.value.kind === 'welcome' || session.value.kind === 'uploading';
const isTyping = (target: EventTarget | null) =>
  target instanceof HTMLTextAreaElement ||
  target instanceof HTMLSelectElement ||
  (target instanceof HTMLInputElement && !/^(range|radio|checkbox|button)$/.test(target.type));
const isSlider = (target: EventTarget | null) => target instanceof HTMLInputElement && target.type === 'range';
const isButton = (target: EventTarget | null) => target instanceof HTMLButtonElement;
