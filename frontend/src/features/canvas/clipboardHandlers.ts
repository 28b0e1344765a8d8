import type { ClipboardEvent } from 'react';
import { copiedText, pasteText } from '@/store/project/clipboard';
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

/** Copy, cut and paste by the browser's own events: they need no permission, unlike reading at will. */
export const clipboardHandlers = {
  onCopy: (event: ClipboardEvent): void => {
    onCopy(event);
  },
  onCut: (event: ClipboardEvent): void => {
    if (onCopy(event)) deleteSelection();
  },
  onPaste: (event: ClipboardEvent): void => {
    if (!isText(event.target) && pasteText(event.clipboardData.getData('text/plain'))) event.preventDefault();
  },
};
