import { useState, useSyncExternalStore } from 'react';

/** The shortest time between two values, in ms; nobody reads a list that changes faster. */
const SETTLED_MS = 120;

interface Subscribable {
  subscribe(changed: () => void): () => void;
}

/**
 * Returns a value of some stores. Of values that follow each other quickly, such as those of a drag over the time
 * axis, only the first and the last are rendered.
 *
 * @param read and `stores` must be the same at each rendering.
 */
export function useSettled<T>(read: () => T, stores: readonly Subscribable[]): T {
  const [settled] = useState(() => settledOf(read, stores));
  return useSyncExternalStore(settled.subscribe, settled.get);
}

function settledOf<T>(read: () => T, stores: readonly Subscribable[]) {
  let value = read();
  let at = -Infinity;
  return {
    get: () => value,
    subscribe: (changed: () => void) => {
      let timer: ReturnType<typeof setTimeout> | undefined;
      const show = () => {
        timer = undefined;
        at = performance.now();
        value = read();
        changed();
      };
      const follow = () => {
        if (timer !== undefined || read() === value) return;
        const wait = at + SETTLED_MS - performance.now();
        if (wait <= 0) show();
        else timer = setTimeout(show, wait);
      };
      const stops = stores.map((store) => store.subscribe(follow));
      value = read();
      return () => {
        clearTimeout(timer);
        stops.forEach((stop) => stop());
      };
    },
  };
}
