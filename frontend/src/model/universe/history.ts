import { difference, inverse, spliced, type Splice } from './splice';

/** One step of undo: how the text changed, and what was selected before and after. */
export interface TextStep {
  /** An i18n key of `universe:edit`. */
  readonly label: string;
  /** Steps with the same key in a row are one. */
  readonly mergeKey: string | null;
  readonly splice: Splice;
  readonly before: readonly string[];
  readonly after: readonly string[];
}

export interface TextHistory {
  /** The text that the next step goes out from. */
  readonly text: string;
  readonly past: readonly TextStep[];
  readonly future: readonly TextStep[];
  readonly sealed: boolean;
}

const LIMIT = 300;

export const startHistory = (text: string): TextHistory => ({ text, past: [], future: [], sealed: true });

export type NewStep = Omit<TextStep, 'splice'>;

/** Notes that the text is now another; the same text is no step. */
export function record(history: TextHistory, text: string, step: NewStep): TextHistory {
  if (text === history.text) return history;
  const last = history.past.at(-1);
  const start = last ? spliced(history.text, inverse(last.splice)) : null;
  if (
    last &&
    start !== null &&
    !history.sealed &&
    step.mergeKey !== null &&
    last.mergeKey === step.mergeKey
  ) {
    const merged = { ...last, splice: difference(start, text), after: step.after };
    return { text, past: [...history.past.slice(0, -1), merged], future: [], sealed: false };
  }
  const next = { ...step, splice: difference(history.text, text) };
  return { text, past: [...history.past, next].slice(-LIMIT), future: [], sealed: false };
}

/** Ends a gesture: the next step stands for itself. */
export const seal = (history: TextHistory): TextHistory =>
  history.sealed ? history : { ...history, sealed: true };

export function undo(history: TextHistory): TextHistory | null {
  const step = history.past.at(-1);
  const text = step ? spliced(history.text, inverse(step.splice)) : null;
  if (!step || text === null) return null;
  return { text, past: history.past.slice(0, -1), future: [step, ...history.future], sealed: true };
}

export function redo(history: TextHistory): TextHistory | null {
  const [step, ...future] = history.future;
  const text = step ? spliced(history.text, step.splice) : null;
  if (!step || text === null) return null;
  return { text, past: [...history.past, step], future, sealed: true };
}
