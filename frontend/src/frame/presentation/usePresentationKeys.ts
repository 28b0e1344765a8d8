import { useEffect } from 'react';
import { endPresentation, usePresentation } from '@/workspace/presentation';

/** What closes with Escape itself, or has a text in it. */
const OWN_ESCAPE =
  'input, textarea, select, [contenteditable=true], [role=dialog], [role=menu], [role=listbox], [role=slider]';

const hasOwnEscape = (target: EventTarget | null): boolean =>
  target instanceof Element && target.closest(OWN_ESCAPE) !== null;

/**
 * While a presentation is shown, Escape ends it, unless something smaller is open or dragged; so does the end
 * of its full screen, since browsers keep that Escape for themselves.
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
    // Before the canvas, for which Escape clears the selection.
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
