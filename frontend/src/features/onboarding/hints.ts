import { create } from 'zustand';

/** The hints for new users, in order; their texts are `onboarding:hint.<id>`. */
export const HINTS = ['build', 'run', 'find'] as const;
export type HintId = (typeof HINTS)[number];

const KEY = 'bts.hints';

function known(): readonly HintId[] {
  const words = (localStorage.getItem(KEY) ?? '').split(' ');
  return HINTS.filter((id) => words.includes(id));
}

/** The hints that the user of this browser has read, or has followed without reading them. */
export const useHints = create<{ readonly done: readonly HintId[] }>(() => ({ done: known() }));

/** Marks a hint as finished, so that it is never shown again. */
export function finishHint(id: HintId): void {
  const { done } = useHints.getState();
  if (done.includes(id)) return;
  const next = [...done, id];
  localStorage.setItem(KEY, next.join(' '));
  useHints.setState({ done: next });
}
