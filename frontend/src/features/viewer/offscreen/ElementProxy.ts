import type { SentEvent, Size } from './messages';

/**
 * Stands in a worker for the canvas of the page: it has its size, receives its events, and reports the cursor
 * that it should show. It is also its own document, since the controls of the camera listen there during a
 * gesture.
 */
export class ElementProxy extends EventTarget {
  readonly style: { cursor: string; touchAction: string };
  clientWidth = 0;
  clientHeight = 0;

  constructor(onCursor: (cursor: string) => void) {
    super();
    let shown = '';
    this.style = {
      touchAction: '',
      get cursor() {
        return shown;
      },
      set cursor(cursor: string) {
        if (cursor !== shown) onCursor(cursor);
        shown = cursor;
      },
    };
  }

  get ownerDocument(): this {
    return this;
  }

  resize({ width, height }: Size): void {
    this.clientWidth = width;
    this.clientHeight = height;
  }

  /** Events arrive with positions relative to the canvas. */
  getBoundingClientRect(): DOMRect {
    return new DOMRect(0, 0, this.clientWidth, this.clientHeight);
  }

  // The page captures the pointer at each press.
  setPointerCapture(): void {}
  releasePointerCapture(): void {}

  receive(sent: SentEvent): void {
    dispatch(this, sent);
  }
}

/** Dispatches an event of the page to a target in the worker. */
export function dispatch(target: EventTarget, { type, ...fields }: SentEvent): void {
  target.dispatchEvent(Object.assign(new Event(type, { cancelable: true }), fields));
}
