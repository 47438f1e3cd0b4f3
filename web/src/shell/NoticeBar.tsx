/** The one place where messages appear. */
import type { JSX } from 'preact';
import { dismiss } from '../store/notices';
import { notice } from '../store/state';
import { Button, IconButton } from './Button';

export function NoticeBar(): JSX.Element | null {
  const now = notice.value;
  if (!now) return null;
  const act = () => {
    dismiss();
    now.action?.run();
  };
  return (
    <div class={`notice card ${now.kind}`} role={now.kind === 'error' ? 'alert' : 'status'} data-own-pointer>
      <p>{now.text}</p>
      {now.action && <Button onClick={act}>{now.action.label}</Button>}
      <IconButton icon="close" label="Dismiss" onClick={dismiss} />
    </div>
  );
}
