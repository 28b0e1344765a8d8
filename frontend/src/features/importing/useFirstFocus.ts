import { useEffect, useRef, type RefObject } from 'react';

/** Focuses an element when it appears: after the dialogue has focused its first button. */
export function useFirstFocus<T extends HTMLElement>(): RefObject<T | null> {
  const element = useRef<T>(null);
  useEffect(() => {
    const timer = setTimeout(() => element.current?.focus());
    return () => clearTimeout(timer);
  }, []);
  return element;
}
