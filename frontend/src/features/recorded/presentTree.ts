import { emptyDiagram, preorder, subtreeOf, type Diagram, type DiagramNode } from '@/model/diagram';
import type { RecordedTree } from '@/store/moment/recordedTrees';

type Diagrams = Readonly<Record<string, Diagram>>;

/** The share of equal nodes from which a tree counts as the renamed one. */
const LEAST_LIKENESS = 0.5;

/**
 * Returns the present tree of one that ran: that of its id, else the most similar one of those that are new
 * since then, which is the tree under another name; null if it is gone.
 */
export function presentOf(ran: Diagram, ids: readonly string[], present: Diagrams): Diagram | null {
  const same = present[ran.id];
  if (same) return same;
  let [best, most]: [Diagram | null, number] = [null, LEAST_LIKENESS];
  for (const diagram of Object.values(present)) {
    if (ids.includes(diagram.id)) continue;
    const share = likeness(ran, diagram);
    if (share > most) [best, most] = [diagram, share];
  }
  return best;
}

/** Returns the share of nodes that have one id and type in both trees. */
function likeness(a: Diagram, b: Diagram): number {
  const [left, right] = [Object.entries(a.nodes), Object.keys(b.nodes)];
  const equal = left.filter(([id, { type }]) => b.nodes[id]?.type === type).length;
  return equal / Math.max(left.length, right.length, 1);
}

/** Returns the two states to compare; without an attached file, only the fields that a recorded node has count. */
export function sidesOf({ diagram, isAttached }: RecordedTree, now: Diagram | null): [Diagram, Diagram] {
  const present = now ?? emptyDiagram(diagram.id);
  return isAttached ? [diagram, present] : [diagram, asRecorded(present)];
}

/** Returns a tree in the form of a recording: enabled nodes, with type, name, tree and ports. */
function asRecorded(diagram: Diagram): Diagram {
  const off = new Set(
    preorder(diagram).flatMap((id) => (diagram.nodes[id]?.disabled ? subtreeOf(diagram, id) : [])),
  );
  const drafts = diagram.drafts.flatMap((id) => subtreeOf(diagram, id));
  for (const id of drafts) off.add(id);
  const nodes = Object.entries(diagram.nodes)
    .filter(([id]) => !off.has(id))
    .map(([id, node]): [string, DiagramNode] => {
      const { type, name, tree, ports, children } = node;
      const kept = children?.filter((child) => !off.has(child));
      return [
        id,
        {
          type,
          ...(name === undefined ? {} : { name }),
          ...(tree === undefined ? {} : { tree }),
          ...(ports ? { ports } : {}),
          ...(kept && kept.length > 0 ? { children: kept } : {}),
        },
      ];
    });
  const root = diagram.root !== null && !off.has(diagram.root) ? diagram.root : null;
  return { ...diagram, root, drafts: [], nodes: Object.fromEntries(nodes) };
}
