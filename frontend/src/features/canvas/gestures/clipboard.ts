import { notifications } from '@mantine/notifications';
import { t } from '@/i18n';
import { clipboardText, copiedText, pasteText } from '@/store/project/edits/clipboard';
import { deleteSelection } from '@/store/project/edits/blocks';
import { isOnCanvas, isTreeInFront } from '../inFront';

/** Pastes what was copied here or elsewhere; a text that holds no blocks is said to be none. */
function pasteOrTell(text: string): void {
  if (!pasteText(text)) notifications.show({ color: 'yellow', message: t('canvas:pastesNothing') });
}

/** The same from a menu, where no event brings the text. */
export async function pasteHere(): Promise<void> {
  pasteOrTell(await clipboardText());
}

function copyTo(clipboard: DataTransfer): boolean {
  const text = copiedText();
  if (text !== null) clipboard.setData('text/plain', text);
  return text !== null;
}

/** The handler of each event; false: there was nothing to copy or paste. */
const HANDLERS = {
  copy: copyTo,
  cut: (clipboard: DataTransfer): boolean => {
    const isCopied = copyTo(clipboard);
    if (isCopied) deleteSelection();
    return isCopied;
  },
  paste: (clipboard: DataTransfer): boolean => {
    pasteOrTell(clipboard.getData('text/plain'));
    return true;
  },
} as const;

const isTextField = (element: Element | null): boolean =>
  element?.matches('input, textarea, [contenteditable=true]') === true;

/**
 * Whether blocks are meant: the canvas has the focus, or nothing has and no words are marked.
 * The browser sends these events to where the caret was left, which may be the tab that was pressed before.
 */
function areBlocksMeant(event: Event): boolean {
  const { activeElement, body } = document;
  if (isOnCanvas()) return !isTextField(activeElement);
  return activeElement === body && event.target === body && isTreeInFront();
}

/** Copy, cut and paste by the browser's own events: they need no permission, unlike reading at will. */
export function followClipboard(): () => void {
  const listening = new AbortController();
  for (const [type, act] of Object.entries(HANDLERS) as [keyof typeof HANDLERS, typeof copyTo][]) {
    const follow = (event: ClipboardEvent) => {
      if (!event.clipboardData || !areBlocksMeant(event) || !act(event.clipboardData)) return;
      event.preventDefault();
      event.stopPropagation();
    };
    document.addEventListener(type, follow, { capture: true, signal: listening.signal });
  }
  return () => listening.abort();
}
