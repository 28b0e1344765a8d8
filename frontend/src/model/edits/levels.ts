import type { Diagram, NodeId } from '../diagram';
import { topsOf, childrenOf } from '../diagram';
import { asPlain, type Recipe } from './core';

/** Returns the blocks that have children, each with the number of levels above it. */
function parentsByDepth(diagram: Diagram): [id: NodeId, depth: number][] {
  const found: [NodeId, number][] = [];
  const open = topsOf(diagram).map((id): [NodeId, number] => [id, 0]);
  for (let next = open.pop(); next; next = open.pop()) {
    const [id, depth] = next;
    const children = childrenOf(diagram, id);
    if (children.length > 0) found.push(next);
    open.push(...children.map((child): [NodeId, number] => [child, depth + 1]));
  }
  return found;
}

/** Folds the tree so that this many levels below its root are visible; Infinity unfolds all. */
export function collapseToLevel(level: number): Recipe {
  return (draft) => {
    for (const [id, depth] of parentsByDepth(asPlain(draft))) {
      const node = draft.nodes[id];
      if (!node) continue;
      if (depth >= level) node.collapsed = true;
      else delete node.collapsed;
    }
  };
}
