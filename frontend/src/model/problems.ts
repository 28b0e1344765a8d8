import { entryCheck, checkPorts } from './check/ports';
import { CODES, type Problem } from './check/problem';
import { checkScripts } from './check/scripts';
import { callCheck } from './check/subtree';
import { subtreeOf, type Diagram, type DiagramNode, type NodeId } from './diagram';
import { specOf, type NodeSpec, type Vocabulary } from './vocabulary';

export { CODES, type Problem, type Severity } from './check/problem';

/**
 * Everything that can be said about a tree without the server, as the translator says it: kept so by
 * `tests/shared/problems.json`, which both are tested on.
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

/** A ReactiveSequence may have one child that goes on by itself. */
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
  const checkEntries = entryCheck();
  return (diagram.root === null ? [] : subtreeOf(diagram, diagram.root)).flatMap((id) => {
    const node = diagram.nodes[id];
    if (!node) return [];
    const spec = specOf(vocabulary, node);
    const scripts = checkScripts(id, node, spec);
    if (!spec) {
      return [{ kind: 'unknown-type', severity: 'error', node: id, values: { type: node.type } }, ...scripts];
    }
    const special =
      spec.family === 'subtree'
        ? checkCalls(id, node)
        : [...checkPorts(id, node, spec), ...checkEntries(id, node, spec)];
    return [...checkChildren(id, node, spec), ...checkWaiting(diagram, node), ...special, ...scripts];
  });
}

/** Ports and scripts are looked at when a tree is built, which the engine does only where it is called. */
const isOfBuilding = ({ kind }: Problem): boolean => /^BT0[23]/.test(CODES[kind][0] ?? '');

/** Everything that can be said about a diagram without the server, in execution order. */
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
