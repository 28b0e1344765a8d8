import { useState } from 'react';

/**
 * Returns whether a button was pressed and the pointer is still on it: then its tooltip would cover what the
 * press has opened.
 */
export function usePressed() {
  const [isPressed, setPressed] = useState(false);
  const handlers = {
    onPointerDown: () => setPressed(true),
    onPointerLeave: () => setPressed(false),
  };
  return { isPressed, handlers };
}
