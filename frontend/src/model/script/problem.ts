export type Span = readonly [from: number, to: number];

/** Why a script cannot be read; its words are `editor:script.<kind>` with `values`. */
export interface ScriptProblem {
  readonly kind: string;
  readonly values: Readonly<Record<string, string>>;
  readonly span: Span;
}
