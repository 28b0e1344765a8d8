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
export interface TextUndo {
  /** The texts that the next step goes out from. */
  readonly texts: readonly string[];
  readonly past: readonly TextStep[];
  readonly future: readonly TextStep[];
  readonly sealed: boolean;
}

const LIMIT = 300;

export const startUndo = (texts: readonly string[]): TextUndo => ({
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
export function record(undoStack: TextUndo, texts: readonly string[], step: NewStep): TextUndo {
  if (texts.every((text, index) => text === undoStack.texts[index])) return undoStack;
  const last = undoStack.past.at(-1);
  const start = last ? splicedEach(undoStack.texts, back(last)) : null;
  if (
    last &&
    start !== null &&
    !undoStack.sealed &&
    step.mergeKey !== null &&
    last.mergeKey === step.mergeKey
  ) {
    const merged = { ...last, splices: differences(start, texts), after: step.after };
    return { texts, past: [...undoStack.past.slice(0, -1), merged], future: [], sealed: false };
  }
  const next = { ...step, splices: differences(undoStack.texts, texts) };
  return { texts, past: [...undoStack.past, next].slice(-LIMIT), future: [], sealed: false };
}

/** Ends a gesture: the next step stands for itself. */
export const seal = (undoStack: TextUndo): TextUndo =>
  undoStack.sealed ? undoStack : { ...undoStack, sealed: true };

export function undo(undoStack: TextUndo): TextUndo | null {
  const step = undoStack.past.at(-1);
  const texts = step ? splicedEach(undoStack.texts, back(step)) : null;
  if (!step || texts === null) return null;
  return { texts, past: undoStack.past.slice(0, -1), future: [step, ...undoStack.future], sealed: true };
}

export function redo(undoStack: TextUndo): TextUndo | null {
  const [step, ...future] = undoStack.future;
  const texts = step ? splicedEach(undoStack.texts, step.splices) : null;
  if (!step || texts === null) return null;
  return { texts, past: [...undoStack.past, step], future, sealed: true };
}
