import { useLayoutEffect, useRef, type FormEvent, type RefObject } from 'react';

/** The elements into which text is typed: inputs, and the script editor. */
const TEXT = 'input:not([type="radio"]), [contenteditable="true"]';

/**
 * Keeps the position of the caret when typing replaces the widget: for example, an opening brace turns a
 * value into a key. The returned handler belongs on the element that contains both widgets.
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
      // The script editor does not report its caret in characters, so the caret of the new widget is at the
      // end.
      caret.current = target instanceof HTMLInputElement ? target.selectionStart : Number.MAX_SAFE_INTEGER;
    },
  };
}
