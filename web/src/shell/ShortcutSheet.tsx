/** The sheet that lists every shortcut. */
import type { JSX } from 'preact';
import { useEffect, useRef } from 'preact/hooks';
import { BLOCK_KEYS } from '../speech/blockKeys';
import { shortcutsShown } from '../store/state';
import { IconButton } from './Button';
import { LANDMARK_KEYS, SHORTCUT_GROUPS, type Shortcut } from './shortcuts';

export function ShortcutSheet(): JSX.Element | null {
  const dialog = useRef<HTMLDialogElement>(null);
  const isShown = shortcutsShown.value;
  useEffect(() => {
    if (isShown) dialog.current?.showModal();
    else dialog.current?.close();
  }, [isShown]);
  const hide = () => {
    shortcutsShown.value = false;
  };
  return (
    <dialog class="sheet" ref={dialog} onClose={hide} aria-label="Keyboard shortcuts">
      <header class="row">
        <h2>Keyboard shortcuts</h2>
        <IconButton icon="close" label="Close" onClick={hide} />
      </header>
      <div class="sheet-columns">
        {SHORTCUT_GROUPS.map(({ label, shortcuts }) => (
          <Keys key={label} label={label} rows={shortcuts.map((shortcut) => [keysText(shortcut), shortcut.label])} />
        ))}
        <Keys label="On a landmark" rows={LANDMARK_KEYS} />
        <Keys label="On a viseme" rows={BLOCK_KEYS} />
      </div>
    </dialog>
  );
}

function Keys({ label, rows }: { readonly label: string; readonly rows: readonly (readonly [string, string])[] }): JSX.Element {
  return (
    <section>
      <h3>{label}</h3>
      <dl>
        {rows.map(([keys, what]) => (
          <div key={keys}>
            <dt>
              <kbd>{keys}</kbd>
            </dt>
            <dd>{what}</dd>
          </div>
        ))}
      </dl>
    </section>
  );
}

const IS_MAC = /Mac|iPhone|iPad/.test(navigator.platform);

function keysText({ keys, shown }: Shortcut): string {
  if (shown) return shown;
  return keys.map((combination) => combination.split('+').filter(Boolean).map(keyName).join(' ') || '+').join(' or ');
}

function keyName(key: string): string {
  if (key === 'mod') return IS_MAC ? '⌘' : 'Ctrl';
  return key.charAt(0).toUpperCase() + key.slice(1);
}
