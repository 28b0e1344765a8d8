import type { KeyBinding } from '@codemirror/view';
import { perform } from '@/commands/registry';
import { formatPython, formatsOnSave } from './ruff';

/** Returns the keys of a Python editor that format and save; other files are saved by the page's shortcut. */
export function saveKeys(path: string): KeyBinding[] {
  if (!path.endsWith('.py')) return [];
  return [
    {
      key: 'Shift-Alt-f',
      preventDefault: true,
      run: (view) => {
        void formatPython(view, path, 'asked');
        return true;
      },
    },
    {
      key: 'Mod-s',
      preventDefault: true,
      run: (view) => {
        const formatted = formatsOnSave() ? formatPython(view, path, 'saving') : Promise.resolve();
        void formatted.then(() => {
          perform('project.save');
        });
        return true;
      },
    },
  ];
}
