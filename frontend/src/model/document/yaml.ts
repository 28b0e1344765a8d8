import { isMap, isScalar, isSeq, LineCounter, parseDocument, type Document, type Node } from 'yaml';
import type { Issue } from './schema';
import type { Json, Path } from './values';

/** The options of the YAML library: the core schema of YAML 1.2, as the simulator and the terminal read it. */
export const YAML_OPTIONS = {
  version: '1.2',
  schema: 'core',
  merge: false,
  uniqueKeys: true,
  logLevel: 'silent',
} as const;

/** The number of cached texts: the texts before and after the last edit are read repeatedly. */
const KEPT = 3;

/** Caches the results of a function for the last few texts. */
export function remembering<T>(make: (text: string) => T): (text: string) => T {
  let known: { text: string; made: T }[] = [];
  return (text) => {
    const old = known.find((each) => each.text === text);
    if (old) return old.made;
    const made = make(text);
    known = [{ text, made }, ...known].slice(0, KEPT);
    return made;
  };
}

/** Returns the parsed YAML of a text; callers must not change it. */
export const parsed = remembering((text) => {
  const lines = new LineCounter();
  return { document: parseDocument(text, { ...YAML_OPTIONS, lineCounter: lines }), lines };
});

function placeAt(lines: LineCounter, offset: number): { line: number; column: number } {
  const { line, col } = lines.linePos(offset);
  return { line: Math.max(line, 1), column: Math.max(col, 1) };
}

/** Returns the offset of the value at a path, or of the nearest value that contains it. */
function offsetOf(document: Document, path: Path): number {
  let node = document.contents as Node | null;
  let offset = node?.range?.[0] ?? 0;
  for (const step of path) {
    if (isMap(node)) {
      const pair = node.items.find(({ key }) => isScalar(key) && String(key.value) === String(step));
      if (!pair) break;
      offset = (pair.key as Node).range?.[0] ?? offset;
      node = pair.value as Node | null;
    } else if (isSeq(node)) {
      node = (node.items[Number(step)] ?? null) as Node | null;
      offset = node?.range?.[0] ?? offset;
    } else break;
  }
  return offset;
}

/** An issue with its place in a text; line and column count from 1. */
export interface DocumentProblem extends Issue {
  /** The index of the text in the document. */
  readonly text: number;
  readonly line: number;
  readonly column: number;
  /** The key of the thing that the issue is about, if it is about one. */
  readonly thing: string | null;
}

/** The longest text that is read, in characters; the simulator has the same limit. */
const LONGEST = 2_000_000;

const START = { text: 0, line: 1, column: 1, thing: null, path: [] } as const;

/** Returns the value of a YAML text, or the syntax error. */
export function valueOfYaml(text: string): { raw: Json } | { problems: DocumentProblem[] } {
  if (text.length > LONGEST) return { problems: [{ ...START, kind: 'tooLong', params: { most: LONGEST } }] };
  const { document, lines } = parsed(text);
  if (document.errors.length > 0) {
    return {
      problems: document.errors.map(({ message, pos: [start] }) => ({
        ...START,
        kind: 'syntax',
        params: { message: (message.split(' at line')[0] ?? message).split('\n')[0] ?? message },
        ...placeAt(lines, start),
      })),
    };
  }
  try {
    return { raw: document.toJS({ maxAliasCount: 100 }) as Json };
  } catch (error) {
    const message = error instanceof Error ? error.message : String(error);
    return { problems: [{ ...START, kind: 'syntax', params: { message } }] };
  }
}

/** Adds places to issues; `thingAt` returns the thing that a path belongs to. */
export function placed(
  text: string,
  issues: readonly Issue[],
  thingAt: (path: Path) => string | null,
): DocumentProblem[] {
  const { document, lines } = parsed(text);
  return issues
    .map((issue) => ({
      ...issue,
      ...placeAt(lines, offsetOf(document, issue.path)),
      text: 0,
      thing: thingAt(issue.path),
    }))
    .sort((a, b) => a.line - b.line || a.column - b.column);
}
