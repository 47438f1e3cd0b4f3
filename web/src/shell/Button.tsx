/** Buttons of the chrome: with words, with an icon, or as a switch. */
import type { ComponentChildren, JSX } from 'preact';
import { Icon, type IconName } from './icons';

type Common = {
  readonly onClick: () => void;
  readonly disabled?: boolean;
};

export function Button({
  children,
  onClick,
  disabled,
  emphasis = 'plain',
}: Common & { readonly children: ComponentChildren; readonly emphasis?: 'plain' | 'primary' | 'quiet' }): JSX.Element {
  return (
    <button type="button" class={`button ${emphasis}`} onClick={onClick} disabled={disabled}>
      {children}
    </button>
  );
}

/** `keys`: the shortcut, shown in the tooltip. `pressed` makes it a switch. */
export function IconButton({
  icon,
  label,
  keys,
  pressed,
  onClick,
  disabled,
}: Common & { readonly icon: IconName; readonly label: string; readonly keys?: string; readonly pressed?: boolean }): JSX.Element {
  return (
    <button
      type="button"
      class="icon-button"
      aria-label={label}
      aria-pressed={pressed}
      title={keys ? `${label} (${keys})` : label}
      onClick={onClick}
      disabled={disabled}
    >
      <Icon name={icon} />
    </button>
  );
}
