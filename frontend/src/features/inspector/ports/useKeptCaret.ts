import { useLayoutEffect, useRef, type FormEvent, type RefObject } from 'react';

/** What text is typed into: inputs, and the editor of scripts. */
const TEXT = 'input:not([type="radio"]), [contenteditable="true"]';

/**
 * Keeps the caret where it was typed when the text itself replaces the widget: a brace makes a value a key.
 * The result belongs on the host of both widgets.
 */
export function useKeptCaret(host: RefObject<HTMLElement | null>, widget: string) {
  const shown = useRef(widget);
  const caret = useRef<number | null>(null);
  useLayoutEffect(() => {
    const text = host.current?.querySelector<HTMLElement>(TEXT);
    if (shown.current !== widget && caret.current !== null && text) {
      text.focus();
      if (text instanceof HTMLInputElement) text.setSelectionRange(caret.current, caret.current);
    }
    shown.current = widget;
    caret.current = null;
  });
  return {
    onInputCapture: ({ target }: FormEvent<HTMLElement>) => {
      // A script has no caret in characters: the key that replaces it is written at its end.
      caret.current = target instanceof HTMLInputElement ? target.selectionStart : Number.MAX_SAFE_INTEGER;
    },
  };
}
