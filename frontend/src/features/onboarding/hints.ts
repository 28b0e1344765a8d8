import { create } from 'zustand';

/** The hints for a first user, one after the other; texts are `onboarding:hint.<id>`. */
export const HINTS = ['build', 'run', 'find'] as const;
export type HintId = (typeof HINTS)[number];

const KEY = 'bts.hints';

function known(): readonly HintId[] {
  const words = (localStorage.getItem(KEY) ?? '').split(' ');
  return HINTS.filter((id) => words.includes(id));
}

/** The hints that this browser's user has read, or made needless by doing what they say. */
export const useHints = create<{ readonly done: readonly HintId[] }>(() => ({ done: known() }));

/** A hint never comes back. */
export function finishHint(id: HintId): void {
  const { done } = useHints.getState();
  if (done.includes(id)) return;
  const next = [...done, id];
  localStorage.setItem(KEY, next.join(' '));
  useHints.setState({ done: next });
}
