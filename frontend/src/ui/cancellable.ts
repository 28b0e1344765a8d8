/** What becomes of a pressed pointer. At most one of `onEnd` and `onCancel` is called, and it is the last. */
export interface Gesture {
  readonly onMove?: (event: PointerEvent) => void;
  /** The button was released. */
  readonly onEnd?: (event: PointerEvent) => void;
  /** The user gave up, or the pointer was lost: all must become as it was before. */
  readonly onCancel: () => void;
}

/**
 * Follows a gesture of the pointer until its button is released. Escape, another button, a lost pointer and a
 * window that loses the focus cancel it; then the click and the menu that would follow are suppressed.
 *
 * It captures no pointer, so that clicks keep their targets. The events are those of the element's own window,
 * which may be one of a popped-out panel. `pointerId` is null where only the mouse is known.
 *
 * @returns a function that stops following, and calls nothing
 */
export function cancellable(element: Element, pointerId: number | null, gesture: Gesture): () => void {
  const view = element.ownerDocument.defaultView ?? window;
  const listening = new AbortController();
  const options = { capture: true, signal: listening.signal };
  const isOther = (event: PointerEvent): boolean => pointerId !== null && event.pointerId !== pointerId;

  const end = (): void => listening.abort();
  const cancel = (): void => {
    end();
    swallowRest(view);
    gesture.onCancel();
  };
  const stop = (event: Event): void => {
    event.preventDefault();
    event.stopImmediatePropagation();
    cancel();
  };
  const onUp = (event: PointerEvent): void => {
    if (isOther(event)) return;
    end();
    gesture.onEnd?.(event);
  };

  view.addEventListener('pointermove', (event) => !isOther(event) && gesture.onMove?.(event), options);
  view.addEventListener('pointerup', onUp, options);
  view.addEventListener('pointercancel', (event) => !isOther(event) && cancel(), options);
  view.addEventListener('keydown', (event) => event.key === 'Escape' && stop(event), options);
  // A second button of the mouse is no `pointerdown` while the first is held.
  view.addEventListener('mousedown', (event) => event.button !== 0 && stop(event), options);
  view.addEventListener('contextmenu', stop, options);
  // Not while it is captured: then it would also be that of each field.
  view.addEventListener('blur', cancel, { signal: listening.signal });
  return end;
}

/** Suppresses what still follows a cancelled gesture, until its buttons are released. */
function swallowRest(view: Window): void {
  const listening = new AbortController();
  const options = { capture: true, signal: listening.signal };
  const end = (): void => listening.abort();
  const swallow = (event: Event): void => {
    event.preventDefault();
    event.stopImmediatePropagation();
  };
  // A key that presses a button makes a click of no count.
  view.addEventListener('click', (event) => event.detail > 0 && swallow(event), options);
  view.addEventListener('contextmenu', swallow, options);
  view.addEventListener('pointerdown', end, options);
  // The click and the menu come right after the last button.
  view.addEventListener('pointerup', (event) => event.buttons === 0 && view.setTimeout(end), options);
}

/** Ends a drag of a library that waits for the mouse's button, as if the button were released nowhere. */
export function releaseMouse(document: Document): void {
  const event = new MouseEvent('mouseup', { bubbles: true });
  // d3 finds its listeners by the window of the event.
  Object.defineProperty(event, 'view', { value: document.defaultView });
  document.dispatchEvent(event);
}
