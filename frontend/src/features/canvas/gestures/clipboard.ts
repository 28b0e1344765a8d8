import { notifications } from '@mantine/notifications';
import { t } from '@/i18n';
import {
  clipboardText,
  copyBlocks,
  noteCopy,
  pasteText,
  selectedBlocks,
  textOf,
} from '@/store/project/edits/clipboard';
import { largePython } from '@/store/saving/large';
import { deleteSelection } from '@/store/project/edits/blocks';
import { isOnCanvas, isTreeInFront } from '../inFront';

const COMPLAINTS = { nothing: 'canvas:pastesNothing', damaged: 'canvas:pastesBlocksOnly' } as const;

/** Pastes blocks that were copied here or elsewhere; notifies the user of what cannot be pasted. */
function pasteOrTell(text: string): void {
  const pasted = pasteText(text);
  if (pasted !== 'blocks') notifications.show({ color: 'yellow', message: t(COMPLAINTS[pasted]) });
}

/** Pastes from a menu, where no event contains the text. */
export async function pasteHere(): Promise<void> {
  pasteOrTell(await clipboardText());
}

function copyTo(clipboard: DataTransfer): boolean {
  const blocks = selectedBlocks();
  const text = blocks && textOf(blocks);
  if (text !== null) clipboard.setData('text/plain', text);
  // An event cannot wait: large actions are copied, too, as soon as they are loaded.
  if (blocks && largePython().length > 0) void copyBlocks(blocks);
  return text !== null;
}

/** The handlers of the events; each returns false if there was nothing to copy or paste. */
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
 * Returns whether a clipboard event is for blocks: the canvas has the focus, or nothing has it and no text is
 * selected. Browsers send such events to the last place of the caret, which may be in a tab that the user has
 * left.
 */
function areBlocksMeant(event: Event): boolean {
  const { activeElement, body } = document;
  if (isOnCanvas()) return !isTextField(activeElement);
  return activeElement === body && event.target === body && isTreeInFront();
}

/**
 * Handles copy, cut and paste through the browser's events, which need no permission, unlike the clipboard
 * API; returns a function that stops it.
 */
export function followClipboard(): () => void {
  const listening = new AbortController();
  for (const [type, act] of Object.entries(HANDLERS) as [keyof typeof HANDLERS, typeof copyTo][]) {
    const follow = (event: ClipboardEvent) => {
      if (!event.clipboardData || !areBlocksMeant(event) || !act(event.clipboardData)) {
        if (type !== 'paste') noteCopy();
        return;
      }
      event.preventDefault();
      event.stopPropagation();
    };
    document.addEventListener(type, follow, { capture: true, signal: listening.signal });
  }
  return () => listening.abort();
}
