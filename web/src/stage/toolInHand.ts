/** The four tools, tied to the state they work on. */
import { signal } from '@preact/signals';
import { edit, landmarksShown, playing, portrait, session, type ToolName, tool, tracedLandmarks } from '../store/state';
import { standingPoints } from './posing';
import { REACH } from './reach';
import type { Tool } from './tools/gesture';
import { panTool } from './tools/panTool';
import { poseTool } from './tools/poseTool';
import { restTool } from './tools/restTool';
import { zoomTool } from './tools/zoomTool';
import type { Size } from './view';
import { stageSize, view } from './viewState';

/** Whether the space bar is held: any tool pans then. */
export const panning = signal(false);

const NO_PORTRAIT: Size = { width: 1, height: 1 };
const portraitSize = () => portrait.value ?? NO_PORTRAIT;
const pan = panTool(portraitSize);
const scale = () => view.value.scale;

const TOOLS: Readonly<Record<ToolName, Tool>> = {
  pose: poseTool({ ...REACH, pan, scale, points: () => standingPoints.value, handlesShown: () => landmarksShown.value && !playing.value }),
  rest: restTool({ ...REACH, pan, scale, landmarks: () => edit.value.landmarks, detected: () => tracedLandmarks.value }),
  pan,
  zoom: zoomTool(portraitSize, () => stageSize.value),
};

export const toolNamed = (name: ToolName): Tool => TOOLS[name];

/** Without landmarks there is nothing to pose: the hand takes over. */
export function toolInHand(): Tool {
  const needsFace = tool.value === 'pose' || tool.value === 'rest';
  const hasFace = session.value.kind === 'editing' && edit.value.landmarks !== null;
  return needsFace && !hasFace ? pan : TOOLS[tool.value];
}
