import { useRef, type MouseEvent } from 'react';

/** The press that brings the focus to a field selects its text, so that typing replaces it. */
export function useFirstPress() {
  const isFirst = useRef(false);
  return {
    onMouseDown: ({ currentTarget }: MouseEvent<HTMLInputElement>) => {
      isFirst.current = document.activeElement !== currentTarget;
    },
    onClick: ({ currentTarget }: MouseEvent<HTMLInputElement>) => {
      const { selectionStart, selectionEnd } = currentTarget;
      // What was selected by dragging stays.
      if (isFirst.current && selectionStart === selectionEnd) currentTarget.select();
    },
  };
}
