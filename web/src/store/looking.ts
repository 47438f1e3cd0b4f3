/** Actions on what is in hand and in view; none of them is a step of the history. */
import { playing, softRadius, type Theme, type ToolName, theme, timeSeconds, tool } from './state';

/** Range of the soft radius, in outer-eye distances. */
export const SOFT_RADII = { min: 0.08, max: 1.2 } as const;
const RADIUS_STEP = 1.25;

export function setSoftRadius(radius: number): void {
  softRadius.value = Math.min(SOFT_RADII.max, Math.max(SOFT_RADII.min, radius));
}

export function growSoftRadius(direction: 1 | -1): void {
  setSoftRadius(softRadius.value * RADIUS_STEP ** direction);
}

export function toggle(which: { value: boolean }): void {
  which.value = !which.value;
}

const THEMES: readonly Theme[] = ['system', 'light', 'dark'];

export function nextTheme(): void {
  theme.value = THEMES[(THEMES.indexOf(theme.value) + 1) % THEMES.length];
}

/** Poses show with any tool but the one that corrects the rest: what poses the portrait puts that down. */
export function leaveRest(): void {
  if (tool.value === 'rest') tool.value = 'pose';
}

/** The rest landmarks are corrected on the resting portrait, so playing stops. */
export function takeTool(name: ToolName): void {
  tool.value = name;
  if (name !== 'rest') return;
  playing.value = false;
  timeSeconds.value = 0;
}
