import { useRef, type MouseEvent } from 'react';

/**
 * Returns handlers that select the text of a field when a press gives it the focus, so that typing replaces
 * the text.
 */
export function useFirstPress() {
  const isFirst = useRef(false);
  return {
    onMouseDown: ({ currentTarget }: MouseEvent<HTMLInputElement>) => {
      isFirst.current = document.activeElement !== currentTarget;
    },
    onClick: ({ currentTarget }: MouseEvent<HTMLInputElement>) => {
      const { selectionStart, selectionEnd } = currentTarget;
      // Text that was selected by dragging stays selected.
      if (isFirst.current && selectionStart === selectionEnd) currentTarget.select();
    },
  };
}
