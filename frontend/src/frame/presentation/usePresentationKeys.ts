import { useEffect } from 'react';
import { endPresentation, usePresentation } from '@/workspace/presentation';

/** Elements that close on Escape themselves, or that contain text. */
const OWN_ESCAPE =
  'input, textarea, select, [contenteditable=true], [role=dialog], [role=menu], [role=listbox], [role=slider]';

const hasOwnEscape = (target: EventTarget | null): boolean =>
  target instanceof Element && target.closest(OWN_ESCAPE) !== null;

/**
 * Ends a presentation on Escape, unless something smaller is open or being dragged. Leaving the full screen
 * also ends it, since browsers do not report that Escape.
 */
export function usePresentationKeys(isOn: boolean): void {
  useEffect(() => {
    if (!isOn) return undefined;
    let isPressed = false;
    const onKey = (event: KeyboardEvent) => {
      if (event.key !== 'Escape' || event.defaultPrevented || isPressed) return;
      if (hasOwnEscape(event.target) || document.querySelector('[role=menu], [aria-modal=true]')) return;
      event.preventDefault();
      event.stopPropagation();
      endPresentation();
    };
    const onPointer = ({ type }: PointerEvent) => {
      isPressed = type === 'pointerdown';
    };
    const onScreen = () => {
      if (!document.fullscreenElement && usePresentation.getState().isFull) endPresentation();
    };
    const pointer = ['pointerdown', 'pointerup', 'pointercancel'] as const;
    // This runs before the canvas's handler, which clears the selection on Escape.
    window.addEventListener('keydown', onKey, { capture: true });
    pointer.forEach((type) => window.addEventListener(type, onPointer, { capture: true }));
    document.addEventListener('fullscreenchange', onScreen);
    return () => {
      window.removeEventListener('keydown', onKey, { capture: true });
      pointer.forEach((type) => window.removeEventListener(type, onPointer, { capture: true }));
      document.removeEventListener('fullscreenchange', onScreen);
    };
  }, [isOn]);
}
