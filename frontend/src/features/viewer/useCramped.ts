import { useEffect, useState, type RefObject } from 'react';

/** The area of the open driving pad, in px². */
const PAD_AREA = 36_000;
const LARGEST_SHARE = 0.25;

/** Returns whether the open pad would cover too much of a view. */
export const isCramped = (width: number, height: number): boolean =>
  width * height > 0 && PAD_AREA / (width * height) > LARGEST_SHARE;

/** Returns whether the view around an element is too small for the open driving pad. */
export function useCramped(element: RefObject<HTMLElement | null>): boolean {
  const [cramped, setCramped] = useState(false);
  useEffect(() => {
    const view = element.current?.parentElement;
    if (!view) return;
    const observer = new ResizeObserver(([entry]) => {
      const { width = 0, height = 0 } = entry?.contentRect ?? {};
      setCramped(isCramped(width, height));
    });
    observer.observe(view);
    return () => observer.disconnect();
  }, [element]);
  return cramped;
}
