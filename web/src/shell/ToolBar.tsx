/** The four tools. */
import type { JSX } from 'preact';
import { takeTool } from '../store/looking';
import { type ToolName, tool } from '../store/state';
import { IconButton } from './Button';
import type { IconName } from './icons';

const TOOLS: readonly { readonly name: ToolName; readonly label: string; readonly keys: string; readonly icon: IconName }[] = [
  { name: 'pose', label: 'Pose', keys: 'V', icon: 'pose' },
  { name: 'rest', label: 'Adjust the landmarks', keys: 'A', icon: 'rest' },
  { name: 'pan', label: 'Pan', keys: 'H, or hold Space', icon: 'pan' },
  { name: 'zoom', label: 'Zoom', keys: 'Z', icon: 'zoom' },
];

export function ToolBar(): JSX.Element {
  return (
    <nav class="tool-bar" aria-label="Tools">
      {TOOLS.map(({ name, label, keys, icon }) => (
        <IconButton key={name} icon={icon} label={label} keys={keys} pressed={tool.value === name} onClick={() => takeTool(name)} />
      ))}
    </nav>
  );
}
