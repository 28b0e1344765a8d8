/** A place in a source; both count from 1, columns in code points. */
export interface PythonPlace {
  readonly line: number;
  readonly column: number;
}

/** A finding of ruff, with the edits that fix it. */
export interface PythonFinding {
  readonly code: string;
  readonly severity: 'error' | 'warning';
  readonly message: string;
  readonly start: PythonPlace;
  readonly end: PythonPlace;
  readonly fix: {
    readonly message: string;
    readonly edits: readonly {
      readonly start: PythonPlace;
      readonly end: PythonPlace;
      readonly content: string;
    }[];
  } | null;
}
