import { create } from 'zustand';
import type { Applied } from '@/generated/messages';
import { useSessionStore } from '@/store/session/store';
import { hasApplication } from './commands';
import { useRunStore } from './store';

/** What replaces the tree: *Apply*, or *Run on*. */
export type Exchange = 'apply' | 'runOn';

interface Asking {
  readonly name: Exchange;
  /** The plan of *Apply* to which the user must agree; null if there is none. */
  readonly plan: Applied | null;
  readonly answer: (agrees: boolean) => void;
}

const nobody: Asking = { name: 'apply', plan: null, answer: () => undefined };

/** The question whether a changed tree may halt what runs. */
export const useApplyQuestion = create<Asking>(() => nobody);

/** Waits for the next answer to *Apply*. Events reach the store a frame after the reply. */
export function nextPlan(): Promise<Applied> {
  return new Promise((resolve) => {
    const end = useSessionStore.subscribe(({ applied }, before) => {
      if (applied === null || applied === before.applied) return;
      end();
      resolve(applied);
    });
  });
}

/** Returns whether a plan does something that the user must know before. */
export const asksFirst = ({ halted, late_ports }: Applied): boolean =>
  halted.length > 0 || late_ports.length > 0;

/**
 * Asks the user if need be; resolves to whether the tree is to be replaced. The question goes away with the
 * program.
 */
export async function agreesTo(plan: Applied, name: Exchange = 'apply'): Promise<boolean> {
  if (!asksFirst(plan)) return true;
  useRunStore.setState({ stage: null });
  let unfollow = () => {};
  const agrees = await new Promise<boolean>((answer) => {
    useApplyQuestion.setState({ name, plan, answer });
    unfollow = useSessionStore.subscribe(() => {
      if (!hasApplication()) answer(false);
    });
  });
  unfollow();
  useApplyQuestion.setState(nobody);
  return agrees;
}
