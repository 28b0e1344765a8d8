import { create } from 'zustand';

/** The steps of the first task in order; their texts are `onboarding:guide.<step>`. */
export const STEPS = ['block', 'fill', 'run'] as const;
export type Step = (typeof STEPS)[number];

const KEY = 'bts.guide';
const DONE = 'done';

const known = (): Step | null => STEPS.find((step) => step === localStorage.getItem(KEY)) ?? null;

interface Guide {
  /** null: the first task is not shown. */
  readonly step: Step | null;
}

/** The progress of a new user's first task; it is stored in this browser. */
export const useGuide = create<Guide>(() => ({ step: known() }));

function go(step: Step | null): void {
  localStorage.setItem(KEY, step ?? DONE);
  useGuide.setState({ step });
}

/** Returns whether the first task was never started, finished or skipped in this browser. */
export const isGuideNew = (): boolean => localStorage.getItem(KEY) === null;

/** Starts the first task, even if it was done before. */
export const startGuide = (): void => go(STEPS[0]);

/** Ends the first task permanently. */
export const endGuide = (): void => go(null);

/** Proceeds to the next step after one was done; returns whether that was the last one. */
export function finishStep(step: Step): boolean {
  if (useGuide.getState().step !== step) return false;
  const next = STEPS[STEPS.indexOf(step) + 1] ?? null;
  go(next);
  return next === null;
}
