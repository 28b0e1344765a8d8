import { notifications } from '@mantine/notifications';
import type { ClipboardEvent } from 'react';
import { t } from '@/i18n';
import { clipboardText, copiedText, pasteText } from '@/store/project/clipboard';
import { deleteSelection } from '@/store/project/commands';

const isText = (target: EventTarget): boolean =>
  target instanceof HTMLElement && target.matches('input, textarea, [contenteditable=true]');

function onCopy(event: ClipboardEvent): boolean {
  const text = isText(event.target) ? null : copiedText();
  if (text === null) return false;
  event.clipboardData.setData('text/plain', text);
  event.preventDefault();
  return true;
}

/** Pastes what was copied here or elsewhere; a text that holds no blocks is said to be none. */
function pasteOrTell(text: string): void {
  if (!pasteText(text)) notifications.show({ color: 'yellow', message: t('canvas:pastesNothing') });
}

/** The same from a menu, where no event brings the text. */
export async function pasteHere(): Promise<void> {
  pasteOrTell(await clipboardText());
}

/** Copy, cut and paste by the browser's own events: they need no permission, unlike reading at will. */
export const clipboardHandlers = {
  onCopy: (event: ClipboardEvent): void => {
    onCopy(event);
  },
  onCut: (event: ClipboardEvent): void => {
    if (onCopy(event)) deleteSelection();
  },
  onPaste: (event: ClipboardEvent): void => {
    if (isText(event.target)) return;
    event.preventDefault();
    pasteOrTell(event.clipboardData.getData('text/plain'));
  },
};
