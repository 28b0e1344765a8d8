import type { Diagnostic } from '@/api/types';
import type { TopicMismatch } from '@/generated/messages';
import type { Diagram, NodeId } from '@/model/diagram';
import { CODES, findProblems, type Problem, type Severity } from '@/model/problems';
import type { Vocabulary } from '@/model/vocabulary';

/** Two ends of a topic that do not match. */
export interface TopicProblem {
  readonly source: 'topic';
  readonly severity: Severity;
  readonly node: null;
  readonly port?: undefined;
  readonly code: TopicMismatch['code'];
  readonly values: Readonly<Record<string, string>>;
}

/** A node on the path of a finding's reason. */
export type ReasonStep = Readonly<Required<Omit<NonNullable<Diagnostic['path']>[number], 'results'>>> & {
  readonly results: readonly string[];
};

/** A finding of the editor's own checks, shown at once, of the server's, shown after a save, or of the run. */
export type ShownProblem =
  | TopicProblem
  | ({ readonly source: 'editor' } & Problem)
  | {
      readonly source: 'server';
      readonly severity: Severity;
      readonly node: NodeId | null;
      readonly port?: string;
      readonly code: string;
      readonly message: string;
      readonly hint: string;
      readonly values?: Readonly<Record<string, string>> | undefined;
      readonly file?: string | null;
      readonly line?: number | null;
      readonly path?: readonly ReasonStep[];
    };

/** Returns whether a finding is silenced at its block, with a reason; errors cannot be. */
export function isSilenced(
  diagram: Diagram,
  {
    code,
    severity,
    node,
  }: { readonly code: string; readonly severity: Severity; readonly node: NodeId | null },
): boolean {
  const reason = node === null ? undefined : diagram.nodes[node]?.silenced?.[code];
  return severity !== 'error' && reason !== undefined && reason.trim() !== '';
}

const placeOf = (code: string, node: NodeId | null, port: string | undefined): string =>
  `${code} ${node ?? ''} ${port ?? ''}`;

/** The code of a tree without a root. */
const EMPTY_TREE = 'BT0101';

/**
 * Returns the findings as they are shown while the user edits. Every new tree is empty, so an empty tree is
 * only a note then; it is an error when it is to run, and the run reports its own findings.
 */
export const whileEditing = (diagnostics: readonly Diagnostic[]): Diagnostic[] =>
  diagnostics.map((each) => (each.code === EMPTY_TREE ? { ...each, severity: 'note' } : each));

const RANK: Record<Severity, number> = { error: 2, warning: 1, note: 0 };

const found = new WeakMap<Diagram, { vocabulary: Vocabulary; problems: readonly Problem[] }>();

function ownProblems(diagram: Diagram, vocabulary: Vocabulary): readonly Problem[] {
  const known = found.get(diagram);
  if (known?.vocabulary === vocabulary) return known.problems;
  const problems = findProblems(diagram, vocabulary);
  found.set(diagram, { vocabulary, problems });
  return problems;
}

/** Returns all findings of one tree, the editor's first; a problem that both have found is listed once. */
export function problemsOf(
  diagram: Diagram,
  vocabulary: Vocabulary,
  diagnostics: readonly Diagnostic[],
): ShownProblem[] {
  const isToRun = diagnostics.some(
    ({ tree, code, severity }) => tree === diagram.id && code === EMPTY_TREE && severity === 'error',
  );
  const severityOf = ({ kind, severity }: Problem): Severity =>
    kind === 'empty-tree' && !isToRun ? 'note' : severity;
  const own = ownProblems(diagram, vocabulary).map(
    (problem) => ({ source: 'editor', ...problem, severity: severityOf(problem) }) as const,
  );
  const told = new Set(
    own.flatMap((problem) => CODES[problem.kind].map((code) => placeOf(code, problem.node, problem.port))),
  );
  const server = diagnostics
    .filter((each) => each.tree === diagram.id)
    .filter((each) => !told.has(placeOf(each.code, each.node || null, each.port || undefined)))
    .filter((each) => !each.node || each.node in diagram.nodes)
    .map((each) => ({
      source: 'server' as const,
      severity: each.severity,
      node: each.node || null,
      ...(each.port ? { port: each.port } : {}),
      code: each.code,
      message: each.message,
      hint: each.hint ?? '',
      values: each.values,
      file: each.file || null,
      line: each.line ?? null,
      ...(each.path && each.path.length > 0 ? { path: each.path } : {}),
    }))
    .filter((each) => !isSilenced(diagram, each));
  const shown = own.filter(
    ({ kind, severity, node }) => !CODES[kind].some((code) => isSilenced(diagram, { code, severity, node })),
  );
  return [...shown, ...server];
}

/**
 * Returns the editor's own finding for one of the server's, if both have found the same: one fault has one
 * wording, and the editor's is in the user's language.
 */
export function ownProblemOf(
  { code, tree, node, port }: Diagnostic,
  diagrams: Readonly<Record<string, Diagram>>,
  vocabulary: Vocabulary,
): ShownProblem | null {
  const diagram = diagrams[tree ?? ''];
  if (!diagram) return null;
  const place = placeOf(code, node || null, port || undefined);
  const own = ownProblems(diagram, vocabulary).find((problem) =>
    CODES[problem.kind].some((each) => placeOf(each, problem.node, problem.port) === place),
  );
  return own ? { source: 'editor', ...own } : null;
}

/** The folder of the behaviour tests: what is wrong in it keeps them from being run, and nothing else. */
const TESTS = 'tests/';

/** Returns the errors among the findings of a check that keep the project from being run and exported. */
export const errorsOf = (diagnostics: readonly Diagnostic[]): Diagnostic[] =>
  diagnostics.filter(({ severity, file }) => severity === 'error' && !file?.startsWith(TESTS));

/** Returns the worst finding of each node. */
export function worstByNode(problems: readonly ShownProblem[]): ReadonlyMap<NodeId, ShownProblem> {
  const worst = new Map<NodeId, ShownProblem>();
  for (const problem of problems) {
    if (problem.node === null) continue;
    const other = worst.get(problem.node);
    if (!other || RANK[problem.severity] > RANK[other.severity]) worst.set(problem.node, problem);
  }
  return worst;
}
