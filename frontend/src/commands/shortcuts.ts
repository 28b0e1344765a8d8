import { useEffect } from 'react';
import { createKeybindingsHandler } from 'tinykeys';
import { useCommandTable, type UserCommand } from './registry';

const isMac = /Mac|iPhone|iPad/.test(navigator.userAgent);

/** Inputs without text: shortcuts work while one of them has the focus. */
const NO_TEXT = ['checkbox', 'radio', 'button', 'submit', 'color', 'file'];

function isTextField(target: EventTarget | null): boolean {
  // `instanceof` fails for a panel in another window, which has classes of its own.
  const { isContentEditable = false, tagName = '', type } = (target ?? {}) as Partial<HTMLInputElement>;
  if (tagName === 'INPUT') return !NO_TEXT.includes(type ?? '');
  return isContentEditable || ['TEXTAREA', 'SELECT'].includes(tagName);
}

/** Whether Escape closes something above the page, which has the focus: a menu, a list or a dialogue. */
function closesItself({ key, target }: KeyboardEvent): boolean {
  const open = '[role=menu], [role=listbox], [role=dialog], [aria-haspopup][aria-expanded=true]';
  return key === 'Escape' && ((target as Partial<Element> | null)?.closest?.(open) ?? null) !== null;
}

function handler(command: UserCommand) {
  return (event: KeyboardEvent) => {
    if (event.defaultPrevented || closesItself(event)) return;
    if (!command.inTextFields && isTextField(event.target)) return;
    if (command.enabled?.() === false) {
      if (command.explain?.()) event.preventDefault();
      return;
    }
    event.preventDefault();
    command.run((event.target as Node | null)?.ownerDocument ?? document);
  };
}

function bind(target: Window, commands: readonly UserCommand[]): () => void {
  const bindings: Record<string, (event: KeyboardEvent) => void> = {};
  // The first handler that is enabled prevents the default, and the others leave such an event alone.
  const inOrder = [...commands].sort((a, b) => Number(b.when !== undefined) - Number(a.when !== undefined));
  for (const command of inOrder) {
    if (!command.shortcut) continue;
    const [first, then] = [bindings[command.shortcut], handler(command)];
    bindings[command.shortcut] = (event) => {
      first?.(event);
      then(event);
    };
  }
  const handle = createKeybindingsHandler(bindings);
  const listen = (event: KeyboardEvent): void => {
    const own = target === window ? event : ownCopy(event);
    handle(own);
    if (own.defaultPrevented) event.preventDefault();
  };
  target.addEventListener('keydown', listen);
  return () => {
    target.removeEventListener('keydown', listen);
  };
}

/** Copies a key event of another window: the library accepts only events of this window's class. */
function ownCopy(event: KeyboardEvent): KeyboardEvent {
  const copy = new KeyboardEvent(event.type, event);
  Object.defineProperty(copy, 'target', { value: event.target });
  return copy;
}

/**
 * Binds all shortcuts of the table to a window, and those that are added later; returns a function that
 * unbinds them.
 */
export function bindShortcuts(target: Window): () => void {
  let unbind = bind(target, Object.values(useCommandTable.getState().commands));
  const unfollow = useCommandTable.subscribe(({ commands }) => {
    unbind();
    unbind = bind(target, Object.values(commands));
  });
  return () => {
    unfollow();
    unbind();
  };
}

/** Binds all shortcuts of the table to this window. */
export function useShortcuts(): void {
  useEffect(() => bindShortcuts(window), []);
}

const KEY_NAMES: Record<string, string> = {
  $mod: isMac ? '⌘' : 'Ctrl',
  Shift: isMac ? '⇧' : 'Shift',
  Alt: isMac ? '⌥' : 'Alt',
  Period: '.',
  Comma: ',',
  Slash: '/',
  Backquote: '`',
  BracketLeft: '[',
  BracketRight: ']',
  Equal: '=',
  Minus: '-',
  Delete: 'Del',
  Escape: 'Esc',
};

interface Keyboard {
  readonly getLayoutMap?: () => Promise<ReadonlyMap<string, string>>;
}

/** What the user's keyboard has printed on its keys, by code; empty where the browser does not say it. */
let printed: ReadonlyMap<string, string> = new Map();

/** Asks the browser for the layout of the keyboard: a shortcut is a place on it, not a character. */
export async function readKeyboard(
  keyboard = (navigator as { readonly keyboard?: Keyboard }).keyboard,
): Promise<void> {
  // A page that is not secure, or lies in a frame, is refused; the names of an American keyboard remain.
  printed = (await keyboard?.getLayoutMap?.().catch(() => undefined)) ?? printed;
}
void readKeyboard();

/** Returns the keys of a command for display; null if it has none. */
export function keysOf({ shortcut, keys }: UserCommand): string | null {
  const known = shortcut ?? keys;
  return known === undefined ? null : shortcutLabel(known);
}

/** Returns a shortcut as it is displayed: `Ctrl+Shift+P`. */
export function shortcutLabel(shortcut: string): string {
  return shortcut
    .split('+')
    .map((part) => printed.get(part)?.toUpperCase() ?? KEY_NAMES[part] ?? part.replace(/^Key|^Digit/, ''))
    .join('+');
}
