import { entryCheck, checkPorts } from './check/ports';
import { CODES, type Problem } from './check/problem';
import { checkScripts } from './check/scripts';
import { callCheck } from './check/subtree';
import { subtreeOf, type Diagram, type DiagramNode, type NodeId } from './diagram';
import { specOf, type NodeSpec, type Vocabulary } from './vocabulary';

export { CODES, type Problem, type Severity } from './check/problem';

/**
 * All checks that need no server. They agree with the translator's: both are tested on
 * `tests/shared/problems.json`.
 */

function checkChildren(id: NodeId, node: DiagramNode, spec: NodeSpec): Problem[] {
  const count = node.children?.length ?? 0;
  const base = {
    severity: 'error',
    node: id,
    values: { type: node.type, count, min: spec.minChildren, max: spec.maxChildren },
  } as const;
  if (count < spec.minChildren) return [{ ...base, kind: 'too-few-children' }];
  if (count > spec.maxChildren) return [{ ...base, kind: 'too-many-children' }];
  return [];
}

/** Reports a second child that keeps state between ticks: a ReactiveSequence may have only one. */
function checkWaiting(diagram: Diagram, node: DiagramNode): Problem[] {
  if (node.type !== 'ReactiveSequence') return [];
  const waiting = (node.children ?? []).filter((child) => diagram.nodes[child]?.type === 'AsyncSequence');
  const second = waiting[1];
  return second === undefined
    ? []
    : [{ kind: 'two-waiting-children', severity: 'error', node: second, values: {} }];
}

function checkTree(diagram: Diagram, vocabulary: Vocabulary): Problem[] {
  const checkCalls = callCheck(diagram.id, vocabulary);
  const checkEntries = entryCheck(diagram, vocabulary);
  return (diagram.root === null ? [] : subtreeOf(diagram, diagram.root)).flatMap((id) => {
    const node = diagram.nodes[id];
    if (!node) return [];
    const spec = specOf(vocabulary, node);
    const own = checkNode(id, node, spec);
    if (!spec) return own;
    if (spec.family === 'subtree') return [...checkCalls(id, node), ...own];
    return [...own, ...checkWaiting(diagram, node), ...checkEntries(id, node, spec)];
  });
}

interface Checked {
  readonly id: NodeId;
  readonly spec: NodeSpec | undefined;
  readonly problems: readonly Problem[];
}

const checked = new WeakMap<DiagramNode, Checked>();

/** Returns the problems of a node that depend on the node and its type alone; cached for unchanged nodes. */
function checkNode(id: NodeId, node: DiagramNode, spec: NodeSpec | undefined): readonly Problem[] {
  const known = checked.get(node);
  if (known && known.id === id && known.spec === spec) return known.problems;
  const scripts = checkScripts(id, node, spec);
  const rest: Problem[] = spec
    ? [...checkChildren(id, node, spec), ...(spec.family === 'subtree' ? [] : checkPorts(id, node, spec))]
    : [{ kind: 'unknown-type', severity: 'error', node: id, values: { type: node.type } }];
  const problems = [...rest, ...scripts];
  checked.set(node, { id, spec, problems });
  return problems;
}

/**
 * Returns whether a problem is found when a tree is built: the engine builds only trees that are called, so
 * ports and scripts of other trees are no errors.
 */
const isOfBuilding = ({ kind }: Problem): boolean => /^BT0[23]/.test(CODES[kind][0] ?? '');

/** Returns all problems of a diagram that can be found without the server, in execution order. */
export function findProblems(diagram: Diagram, vocabulary: Vocabulary): Problem[] {
  const runs = vocabulary.reachable.has(diagram.id);
  const found = checkTree(diagram, vocabulary).map((problem) =>
    runs || problem.severity !== 'error' || !isOfBuilding(problem)
      ? problem
      : { ...problem, severity: 'warning' as const },
  );
  const empty: Problem = { kind: 'empty-tree', severity: runs ? 'error' : 'note', node: null, values: {} };
  const drafts = diagram.drafts.map((id): Problem => ({
    kind: 'draft',
    severity: 'note',
    node: id,
    values: {},
  }));
  return [...(diagram.root === null ? [empty] : []), ...found, ...drafts];
}
