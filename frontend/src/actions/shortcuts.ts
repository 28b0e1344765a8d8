import { useEffect } from 'react';
import { tinykeys } from 'tinykeys';
import { useActionTable, type UserAction } from './registry';

const isMac = /Mac|iPhone|iPad/.test(navigator.userAgent);

function isTextField(target: EventTarget | null): boolean {
  return (
    target instanceof HTMLElement &&
    (target.isContentEditable || ['INPUT', 'TEXTAREA', 'SELECT'].includes(target.tagName))
  );
}

function handler(action: UserAction) {
  return (event: KeyboardEvent) => {
    if (event.defaultPrevented) return;
    if (!action.inTextFields && isTextField(event.target)) return;
    if (action.enabled?.() === false) return;
    event.preventDefault();
    action.run();
  };
}

/** Binds every shortcut of the table to the window. */
export function useShortcuts(): void {
  const actions = useActionTable((table) => table.actions);
  useEffect(() => {
    const bindings: Record<string, (event: KeyboardEvent) => void> = {};
    for (const action of Object.values(actions)) {
      if (action.shortcut) bindings[action.shortcut] = handler(action);
    }
    return tinykeys(window, bindings);
  }, [actions]);
}

const KEY_NAMES: Record<string, string> = { $mod: isMac ? '⌘' : 'Ctrl', Shift: isMac ? '⇧' : 'Shift' };

/** A shortcut as people write it: `Ctrl+Shift+P`. */
export function shortcutLabel(shortcut: string): string {
  return shortcut
    .split('+')
    .map((part) => KEY_NAMES[part] ?? part.replace(/^Key|^Digit/, ''))
    .join('+');
}
