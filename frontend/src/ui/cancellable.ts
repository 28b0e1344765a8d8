/** The handlers of a gesture. At most one of `onEnd` and `onCancel` is called, as the last call. */
export interface Gesture {
  readonly onMove?: (event: PointerEvent) => void;
  /** Called when the button is released. */
  readonly onEnd?: (event: PointerEvent) => void;
  /**
   * Called when the user cancels or the pointer is lost; it must restore the state from before the gesture.
   */
  readonly onCancel: () => void;
}

/**
 * Follows a gesture of the pointer until its button is released. Escape, another button, a lost pointer and a
 * window that loses the focus cancel the gesture; then the click and the menu that would follow are
 * suppressed.
 *
 * The pointer is not captured, so that clicks keep their targets. The listeners are on the element's own
 * window, which may be that of a popped-out panel. `pointerId` is null if only mouse events are known.
 *
 * @returns a function that stops following without calling a handler
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
  // Pressing a second button of the mouse while the first is held causes no `pointerdown`.
  view.addEventListener('mousedown', (event) => event.button !== 0 && stop(event), options);
  view.addEventListener('contextmenu', stop, options);
  // Without `capture`, since a captured `blur` would also be that of each field.
  view.addEventListener('blur', cancel, { signal: listening.signal });
  return end;
}

/** Suppresses the events that follow a cancelled gesture, until all buttons are released. */
function swallowRest(view: Window): void {
  const listening = new AbortController();
  const options = { capture: true, signal: listening.signal };
  const end = (): void => listening.abort();
  const swallow = (event: Event): void => {
    event.preventDefault();
    event.stopImmediatePropagation();
  };
  // A key that presses a button causes a click whose `detail` is 0.
  view.addEventListener('click', (event) => event.detail > 0 && swallow(event), options);
  view.addEventListener('contextmenu', swallow, options);
  view.addEventListener('pointerdown', end, options);
  // The click and the menu follow directly after the last button is released.
  view.addEventListener('pointerup', (event) => event.buttons === 0 && view.setTimeout(end), options);
}

/**
 * Ends a drag of a library that waits for the release of the mouse button, as if it were released outside of
 * everything.
 */
export function releaseMouse(document: Document): void {
  const event = new MouseEvent('mouseup', { bubbles: true });
  // d3 finds its listeners by the event's window.
  Object.defineProperty(event, 'view', { value: document.defaultView });
  document.dispatchEvent(event);
}
