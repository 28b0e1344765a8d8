import { useLayoutEffect, useRef, type RefObject } from 'react';
import type { NodeStatus } from '@/generated/messages';
import { pastOf, useLiveStore, usePastLive, type Flash, type LiveKey } from '@/store/project/live';
import { useMoment } from './store';

/** What a view shows of the status of a block. */
export interface ShownStatus {
  readonly status: NodeStatus;
  /** The status in the last tick, if the block is idle again. */
  readonly past: NodeStatus | undefined;
  /** The status that the block had only within the last tick. */
  readonly flash: Flash | undefined;
  readonly hasFault: boolean;
}

interface Painted {
  shown: ShownStatus;
  readonly paints: Set<(shown: ShownStatus) => void>;
}

const painted = new Map<LiveKey, Painted>();
const listeners = new Set<() => void>();

const stateNow = () => (useMoment.getState().shown === null ? useLiveStore : usePastLive).getState();
let state = stateNow();

/** Returns what a block shows at the shown moment. */
export const shownStatus = (key: LiveKey): ShownStatus => ({
  status: state.statuses.get(key) ?? 'IDLE',
  past: pastOf(state, key),
  flash: state.flashes.get(key),
  hasFault: state.faults.has(key),
});

const isSame = (a: ShownStatus, b: ShownStatus): boolean =>
  a.status === b.status && a.past === b.past && a.flash === b.flash && a.hasFault === b.hasFault;

/** Paints the blocks whose status changed; the others are not touched. */
function repaint(): void {
  const now = stateNow();
  if (now === state) return;
  state = now;
  for (const [key, each] of painted) {
    const shown = shownStatus(key);
    if (isSame(shown, each.shown)) continue;
    each.shown = shown;
    each.paints.forEach((paint) => paint(shown));
  }
  listeners.forEach((changed) => changed());
}

for (const store of [useLiveStore, usePastLive, useMoment]) store.subscribe(repaint);

/**
 * Calls `paint` now and whenever the status of a block changes; returns a function that stops it. Hundreds of
 * blocks change at a moment, and each would be rendered by React; a painter writes the few attributes.
 */
export function paintStatus(key: LiveKey, paint: (shown: ShownStatus) => void): () => void {
  let each = painted.get(key);
  if (!each) painted.set(key, (each = { shown: shownStatus(key), paints: new Set() }));
  const { paints } = each;
  paints.add(paint);
  paint(each.shown);
  return () => {
    paints.delete(paint);
    if (paints.size === 0 && painted.get(key)?.paints === paints) painted.delete(key);
  };
}

/** Calls back when any status may have changed. */
export function onStatuses(changed: () => void): () => void {
  listeners.add(changed);
  return () => listeners.delete(changed);
}

/** Returns a reference for an element on which the status of a block is painted, outside of React. */
export function usePaintedStatus<T extends Element>(
  key: LiveKey,
  paint: (element: T, shown: ShownStatus) => void,
): RefObject<T | null> {
  const ref = useRef<T>(null);
  useLayoutEffect(() => {
    const element = ref.current;
    return element ? paintStatus(key, (shown) => paint(element, shown)) : undefined;
  }, [key, paint]);
  return ref;
}

/** Sets an attribute, or removes it if there is no value; an attribute that is right is not touched. */
export function write(element: Element, name: string, value: string | undefined): void {
  if ((element.getAttribute(name) ?? undefined) === value) return;
  if (value === undefined) element.removeAttribute(name);
  else element.setAttribute(name, value);
}
