import type { Diagnostic, Severity } from '@/api/types';
import type { Fault, LaunchNode, TopicMismatch } from '@/generated/messages';
import type { Diagram, NodeId } from '@/model/diagram';
import { CODES } from '@/model/problems';
import type { Vocabulary } from '@/model/vocabulary';
import type { CodeFinding } from '@/store/language';
import { problemsOf, type ShownProblem } from '@/store/project/problems';
import { NOT_LOOKED_AT } from './robots';
import { isSuperseded, lintFindings } from './syntax';
import type { Linted, TextErrors } from './texts';
import { placeOfTopic } from './topicPlace';

/** One row of the list: a finding with its place. */
export interface ListedProblem {
  readonly problem: ShownProblem;
  readonly severity: Severity;
  readonly code: string;
  readonly isFault: boolean;
  readonly tree: string | null;
  readonly node: NodeId | null;
  readonly port: string;
  readonly file: string | null;
  readonly line: number | null;
  /** The topic that the finding is about, if there is one. */
  readonly topic: string | null;
}

type ByPath<T> = Readonly<Record<string, T>>;

/** The data from which the list is made. */
export interface ProblemSources {
  readonly files: ByPath<{ readonly text?: string | null }>;
  readonly diagrams: ByPath<Diagram>;
  readonly vocabulary: Vocabulary;
  readonly diagnostics: readonly Diagnostic[];
  /** The findings in robots with macros; null if nobody has looked at them. */
  readonly robots: readonly Diagnostic[] | null;
  readonly served: ByPath<readonly CodeFinding[]>;
  readonly linted: ByPath<Linted>;
  readonly errors: ByPath<TextErrors>;
  readonly faults: readonly Fault[];
  readonly mismatches: readonly TopicMismatch[];
  readonly launchNodes: readonly LaunchNode[];
}

const RANK: Record<Severity, number> = { error: 0, warning: 1, note: 2 };

const NOWHERE = {
  isFault: false,
  tree: null,
  node: null,
  port: '',
  file: null,
  line: null,
  topic: null,
} as const;

interface Words {
  readonly severity: Severity;
  readonly code: string;
  readonly message: string;
  readonly hint?: string | null;
}

/** Returns a row with the text of a checker other than the editor. */
function rowOf(
  { severity, code, message, hint }: Words,
  place: Partial<ListedProblem>,
  values?: Diagnostic['values'],
): ListedProblem {
  const node = place.node ?? null;
  const problem: ShownProblem = {
    source: 'server',
    severity,
    node,
    code,
    message,
    hint: hint ?? '',
    ...(values ? { values } : {}),
  };
  return { ...NOWHERE, problem, severity, code, ...place };
}

function faultRow(fault: Fault, { files }: ProblemSources): ListedProblem {
  const isOurs = fault.file in files && fault.line > 0;
  return rowOf(
    { severity: 'error', code: fault.kind, message: fault.message, hint: fault.hint },
    {
      isFault: true,
      tree: fault.tree_id || null,
      node: fault.node_id || null,
      ...(isOurs ? { file: fault.file, line: fault.line } : {}),
    },
  );
}

function topicRow(mismatch: TopicMismatch, sources: ProblemSources): ListedProblem {
  const { topic, publisher, subscriber, code, reason, values } = mismatch;
  // An end that is missing may still come.
  const severity: Severity = reason === 'nobody' ? 'warning' : 'error';
  const problem: ShownProblem = {
    source: 'topic',
    severity,
    node: null,
    code,
    values: { ...values, topic, publisher, subscriber },
  };
  return { ...NOWHERE, problem, severity, code, topic, ...placeOfTopic(mismatch, sources) };
}

function treeRows(diagram: Diagram, { vocabulary, diagnostics }: ProblemSources): ListedProblem[] {
  return problemsOf(diagram, vocabulary, diagnostics).map((problem) => {
    const { severity, node, port = '' } = problem;
    const code = problem.source === 'editor' ? (CODES[problem.kind][0] ?? '') : problem.code;
    const place =
      problem.source === 'server' ? { file: problem.file ?? null, line: problem.line ?? null } : {};
    return { ...NOWHERE, problem, severity, code, tree: diagram.id, node, port, ...place };
  });
}

function savedRows(sources: ProblemSources): ListedProblem[] {
  const { diagnostics, robots, diagrams, served, linted, errors } = sources;
  const saved = robots
    ? [...diagnostics.filter(({ code }) => code !== NOT_LOOKED_AT), ...robots]
    : diagnostics;
  return saved
    .filter(({ tree }) => !tree || !(tree in diagrams))
    .filter((item) => {
      const path = item.file ?? '';
      return !isSuperseded(item, { served: served[path], linted: linted[path], errors: errors[path] });
    })
    .map((item) =>
      rowOf(
        item,
        {
          tree: item.tree || null,
          node: item.node || null,
          port: item.port ?? '',
          file: item.file || null,
          line: item.line ?? null,
        },
        item.values,
      ),
    );
}

function fileRows(path: string, sources: ProblemSources): ListedProblem[] {
  const found = { served: sources.served[path], linted: sources.linted[path], errors: sources.errors[path] };
  return [
    ...(found.served ?? []).map(({ severity, source, message, from }) =>
      rowOf(
        { severity: severity === 'info' ? 'note' : severity, code: source, message },
        { file: path, line: from.line + 1 },
      ),
    ),
    ...lintFindings(found).map(({ severity, code, message, start }) =>
      rowOf({ severity, code: `ruff ${code}`, message }, { file: path, line: start.line }),
    ),
    ...(found.errors?.errors ?? []).map(({ message, line }) =>
      rowOf({ severity: 'error', code: '', message }, { file: path, line }),
    ),
  ];
}

/**
 * Returns all findings of the project, the worst first: those of the run, of the trees, of the last save, and
 * of the texts.
 */
export function listProblems(sources: ProblemSources): readonly ListedProblem[] {
  const { faults, diagrams, files, served, linted, errors } = sources;
  const texts = new Set([served, linted, errors].flatMap((found) => Object.keys(found)));
  const rows = [
    ...faults.map((fault) => faultRow(fault, sources)),
    ...sources.mismatches.map((mismatch) => topicRow(mismatch, sources)),
    ...Object.values(diagrams).flatMap((diagram) => treeRows(diagram, sources)),
    ...savedRows(sources),
    ...[...texts].filter((path) => path in files).flatMap((path) => fileRows(path, sources)),
  ];
  return rows.sort((a, b) => RANK[a.severity] - RANK[b.severity]);
}

export type Worst = 'error' | 'warning';

/**
 * Returns the worst error or warning of each file that has one; a finding in a tree counts for the tree's
 * file.
 */
export function worstByFile(rows: readonly ListedProblem[]): ReadonlyMap<string, Worst> {
  const worst = new Map<string, Worst>();
  for (const { severity, file, tree } of rows) {
    if (severity === 'note') continue;
    for (const path of [file, tree === null ? null : `trees/${tree}.json`]) {
      if (path !== null && worst.get(path) !== 'error') worst.set(path, severity);
    }
  }
  return worst;
}

export interface ProblemCounts {
  readonly errors: number;
  readonly warnings: number;
}

export function countProblems(rows: readonly ListedProblem[]): ProblemCounts {
  const of = (wanted: Severity) => rows.filter(({ severity }) => severity === wanted).length;
  return { errors: of('error'), warnings: of('warning') };
}
