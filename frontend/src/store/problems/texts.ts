import { create } from 'zustand';
import type { PythonFinding } from '@/api/python';

/** Findings of ruff, together with the text that they refer to. */
export interface Linted {
  readonly text: string;
  readonly findings: readonly PythonFinding[];
}

/** The place where a text violates the format of its file type; `line` counts from 1. */
export interface TextError {
  readonly offset: number;
  readonly line: number;
  readonly message: string;
}

/** The syntax errors of a text, together with that text. */
export interface TextErrors {
  readonly text: string;
  readonly errors: readonly TextError[];
}

interface TextFindings {
  /** The findings in Python files that are open or have changed. */
  readonly linted: Readonly<Record<string, Linted>>;
  /** The syntax errors of open JSON, YAML and XML files. */
  readonly errors: Readonly<Record<string, TextErrors>>;
}

/** The findings in texts while the user edits them, by path; they are neither saved nor undone. */
export const useTextFindings = create<TextFindings>(() => ({ linted: {}, errors: {} }));

type Kind = keyof TextFindings;

/** Sets the findings in a file; null removes them. */
export function setTextFindings<K extends Kind>(
  kind: K,
  path: string,
  found: TextFindings[K][string] | null,
): void {
  const { [path]: before, ...others } = useTextFindings.getState()[kind];
  if (before === undefined && found === null) return;
  useTextFindings.setState({ [kind]: found === null ? others : { ...others, [path]: found } });
}

export function clearTextFindings(): void {
  useTextFindings.setState(useTextFindings.getInitialState(), true);
}
