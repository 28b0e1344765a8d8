import { useEffect, type RefObject } from 'react';

/**
 * Calls back when the user zooms in on an element: by a pinch, which browsers report as a turn of the wheel with
 * Ctrl, or by that itself. Listens by itself, since React's listener could not keep the page from being zoomed.
 */
export function usePinch(
  element: RefObject<HTMLElement | null>,
  onZoomIn: (event: WheelEvent) => void,
): void {
  useEffect(() => {
    const target = element.current;
    const turned = (event: WheelEvent) => {
      if (!event.ctrlKey && !event.metaKey) return;
      event.preventDefault();
      if (event.deltaY < 0) onZoomIn(event);
    };
    target?.addEventListener('wheel', turned, { passive: false });
    return () => target?.removeEventListener('wheel', turned);
  }, [element, onZoomIn]);
}
