/** The whole page. */
import { useSignalEffect } from '@preact/signals';
import type { JSX } from 'preact';
import { useEffect } from 'preact/hooks';
import { SidePanel } from '../panels/SidePanel';
import { Stage } from '../stage/Stage';
import { endedUnseen, watchEnd } from '../store/absence';
import { announcement, job, session, theme } from '../store/state';
import { Timeline } from '../timeline/Timeline';
import { listenToDrops } from '../welcome/incoming';
import { Welcome } from '../welcome/Welcome';
import { NoticeBar } from './NoticeBar';
import { ShortcutSheet } from './ShortcutSheet';
import { listenToShortcuts } from './shortcuts';
import { ToolBar } from './ToolBar';
import { TopBar } from './TopBar';

export function App(): JSX.Element {
  useEffect(listenToShortcuts, []);
  useEffect(listenToDrops, []);
  useEffect(watchEnd, []);
  useSignalEffect(() => {
    document.documentElement.dataset.theme = theme.value;
  });
  useSignalEffect(() => {
    document.title = titleOf();
  });
  const isWelcome = session.value.kind === 'welcome';
  return (
    <div class={isWelcome ? 'app at-welcome' : 'app'}>
      <TopBar />
      {isWelcome ? (
        <>
          <Welcome />
          <div class="stage-messages">
            <NoticeBar />
          </div>
        </>
      ) : (
        <Workbench />
      )}
      <ShortcutSheet />
      <p class="visually-hidden" aria-live="polite">
        {announcement.value}
      </p>
    </div>
  );
}

function Workbench(): JSX.Element {
  return (
    <>
      <ToolBar />
      <Stage />
      <SidePanel />
      <Timeline />
    </>
  );
}

function titleOf(): string {
  if (endedUnseen.value) return `${endedUnseen.value} · VectorTalker`;
  const running = job.value?.phase === 'running' ? `${Math.round(job.value.progress * 100)} % · ` : '';
  return `${running}VectorTalker`;
}
