/** The bar above everything: name, undo, theme, help, open, save, export. */
import type { JSX } from 'preact';
import { ExportMenu } from '../export/ExportMenu';
import { offerDeletion } from '../project/deletion';
import { openProjectFile, saveProject } from '../project/files';
import { nextTheme } from '../store/looking';
import { report } from '../store/notices';
import { leavePortrait, rename } from '../store/opening';
import { documentName, scene, session, shortcutsShown, theme } from '../store/state';
import { nextRedo, nextUndo, redoStep, type Step, undoStep } from '../store/steps';
import { Button, IconButton } from './Button';
import type { IconName } from './icons';
import { PROJECTS, pickFile } from './pickFile';

const THEME_ICONS = { system: 'contrast', light: 'sun', dark: 'moon' } as const satisfies Record<string, IconName>;

export function TopBar(): JSX.Element {
  const isOpen = session.value.kind !== 'welcome';
  return (
    <header class="top-bar">
      <button
        type="button"
        class="brand"
        aria-label="VectorTalker: start with another portrait"
        title="Start with another portrait"
        onClick={leavePortrait}
        disabled={!isOpen}
      >
        <BrandMark />
        <span class="brand-name">VectorTalker</span>
      </button>
      {isOpen && <h1 class="visually-hidden">{documentName.value}</h1>}
      {isOpen && <NameAndSteps />}
      <div class="spacer" />
      <div class="row apart">
        <IconButton icon={THEME_ICONS[theme.value]} label={`Theme: ${theme.value}`} onClick={nextTheme} />
        <IconButton
          icon="keyboard"
          label="Keyboard shortcuts"
          keys="?"
          onClick={() => {
            shortcutsShown.value = true;
          }}
        />
        <Button emphasis="quiet" onClick={() => pickFile(PROJECTS, (file) => openProjectFile(file).catch(report))}>
          Open
        </Button>
      </div>
      {isOpen && (
        <>
          <IconButton icon="trash" label="Delete this portrait" onClick={offerDeletion} />
          <Button disabled={!scene.value} onClick={() => saveProject().catch(report)}>
            Save
          </Button>
          <ExportMenu />
        </>
      )}
    </header>
  );
}

function NameAndSteps(): JSX.Element {
  return (
    <>
      <input
        class="name-field"
        aria-label="Name of the portrait"
        value={documentName.value}
        onChange={(event) => rename(event.currentTarget.value)}
        onKeyDown={(event) => event.key === 'Enter' && event.currentTarget.blur()}
      />
      <StepButton icon="undo" label="Undo" keys="Ctrl Z" to={nextUndo.value} onClick={undoStep} />
      <StepButton icon="redo" label="Redo" keys="Ctrl Shift Z" to={nextRedo.value} onClick={redoStep} />
    </>
  );
}

type StepButtonProps = {
  readonly icon: IconName;
  readonly label: string;
  readonly keys: string;
  readonly to: Step;
  readonly onClick: () => void;
};

function StepButton({ icon, label, keys, to, onClick }: StepButtonProps): JSX.Element {
  const meaning = to.kind === 'portrait' ? `${label}: back to “${to.name}”` : label;
  return <IconButton icon={icon} label={meaning} keys={keys} disabled={to.kind === 'none'} onClick={onClick} />;
}

function BrandMark(): JSX.Element {
  return (
    <svg class="brand-mark" viewBox="0 0 24 24" width="24" height="24" aria-hidden="true">
      <path class="face" d="M12 2.500c5 0 8 3.600 8 8.600 0 5.600-3.600 10.400-8 10.400s-8-4.800-8-10.400c0-5 3-8.600 8-8.600Z" />
      <path class="mouth" d="M7.600 13.600c2.800 1 6 1 8.800 0-.6 2.700-2.300 4.100-4.400 4.100s-3.800-1.400-4.400-4.100Z" />
      <circle cx="8.800" cy="9.300" r="1.200" />
      <circle cx="15.200" cy="9.300" r="1.200" />
    </svg>
  );
}
