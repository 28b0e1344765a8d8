export type Span = readonly [from: number, to: number];

/** The syntax error of a script; its text is `editor:script.<kind>` with `values`. */
export interface ScriptProblem {
  readonly kind: string;
  readonly values: Readonly<Record<string, string>>;
  readonly span: Span;
}
