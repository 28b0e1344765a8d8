import { useState } from 'react';

/**
 * Returns whether a button was pressed and the pointer has not left it since: then its tooltip would only be
 * in the way.
 */
export function usePressed() {
  const [isPressed, setPressed] = useState(false);
  const handlers = {
    onPointerDown: () => setPressed(true),
    onPointerLeave: () => setPressed(false),
  };
  return { isPressed, handlers };
}
