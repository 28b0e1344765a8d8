import { difference, inverse, spliced, type Splice } from './splice';

/** One step of undo: how the texts of a document changed, and what was selected before and after. */
export interface TextStep {
  readonly label: string;
  /** Steps with the same key in a row are one. */
  readonly mergeKey: string | null;
  /** One a text. */
  readonly splices: readonly Splice[];
  readonly before: readonly string[];
  readonly after: readonly string[];
}

/** The steps of a document that is written in one file or in several. */
export interface TextHistory {
  /** The texts that the next step goes out from. */
  readonly texts: readonly string[];
  readonly past: readonly TextStep[];
  readonly future: readonly TextStep[];
  readonly sealed: boolean;
}

const LIMIT = 300;

export const startHistory = (texts: readonly string[]): TextHistory => ({
  texts,
  past: [],
  future: [],
  sealed: true,
});

export type NewStep = Omit<TextStep, 'splices'>;

/** Texts after a splice each; null where one was not made for what stands there. */
function splicedEach(texts: readonly string[], splices: readonly Splice[]): readonly string[] | null {
  const after = texts.map((text, index) => {
    const splice = splices[index];
    return splice ? spliced(text, splice) : text;
  });
  return after.every((text) => text !== null) ? after : null;
}

const back = (step: TextStep): Splice[] => step.splices.map(inverse);
const differences = (before: readonly string[], after: readonly string[]): Splice[] =>
  after.map((text, index) => difference(before[index] ?? '', text));

/** Notes that the texts are now others; the same texts are no step. */
export function record(history: TextHistory, texts: readonly string[], step: NewStep): TextHistory {
  if (texts.every((text, index) => text === history.texts[index])) return history;
  const last = history.past.at(-1);
  const start = last ? splicedEach(history.texts, back(last)) : null;
  if (
    last &&
    start !== null &&
    !history.sealed &&
    step.mergeKey !== null &&
    last.mergeKey === step.mergeKey
  ) {
    const merged = { ...last, splices: differences(start, texts), after: step.after };
    return { texts, past: [...history.past.slice(0, -1), merged], future: [], sealed: false };
  }
  const next = { ...step, splices: differences(history.texts, texts) };
  return { texts, past: [...history.past, next].slice(-LIMIT), future: [], sealed: false };
}

/** Ends a gesture: the next step stands for itself. */
export const seal = (history: TextHistory): TextHistory =>
  history.sealed ? history : { ...history, sealed: true };

export function undo(history: TextHistory): TextHistory | null {
  const step = history.past.at(-1);
  const texts = step ? splicedEach(history.texts, back(step)) : null;
  if (!step || texts === null) return null;
  return { texts, past: history.past.slice(0, -1), future: [step, ...history.future], sealed: true };
}

export function redo(history: TextHistory): TextHistory | null {
  const [step, ...future] = history.future;
  const texts = step ? splicedEach(history.texts, step.splices) : null;
  if (!step || texts === null) return null;
  return { texts, past: [...history.past, step], future, sealed: true };
}
