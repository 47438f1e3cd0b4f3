/** Theme and detail, kept in this browser from one visit to the next. */
import { effect } from '@preact/signals';
import { preset, theme } from './state';

const KEY = 'vectortalker-preferences';

/** Restores what was chosen before, and keeps what is chosen from now on. */
export function keepPreferences(): void {
  const kept: unknown = JSON.parse(localStorage.getItem(KEY) ?? '{}');
  if (typeof kept === 'object' && kept !== null) restore(kept);
  effect(() => localStorage.setItem(KEY, JSON.stringify({ theme: theme.value, preset: preset.value })));
}

function restore(kept: { readonly theme?: unknown; readonly preset?: unknown }): void {
  if (kept.theme === 'light' || kept.theme === 'dark') theme.value = kept.theme;
  if (kept.preset === 'draft' || kept.preset === 'fine') preset.value = kept.preset;
}
