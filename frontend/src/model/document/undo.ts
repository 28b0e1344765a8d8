import { difference, inverse, spliced, type Splice } from './splice';

/** One step of undo: the changes of a document's texts, and the selection before and after. */
export interface TextStep {
  readonly label: string;
  /** Consecutive steps with the same key are merged. */
  readonly mergeKey: string | null;
  /** One splice for each text. */
  readonly splices: readonly Splice[];
  readonly before: readonly string[];
  readonly after: readonly string[];
}

/** The undo stack of a document of one or several files. */
export interface TextUndo {
  /** The texts on which the next step is based. */
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

/** Applies one splice to each text; null if a splice does not fit its text. */
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

/** Records new texts as a step; unchanged texts make no step. */
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

/** Ends a gesture: the next step is not merged with the last one. */
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
