import { childrenOf, topsOf, type Diagram, type NodeId } from './diagram';

/** One line of the outline. */
export interface OutlineLine {
  readonly id: NodeId;
  readonly depth: number;
  readonly hasChildren: boolean;
  readonly isFolded: boolean;
  readonly isDraft: boolean;
}

/** All visible lines in execution order; a folded node hides the lines below it. */
export function outlineRows(diagram: Diagram): OutlineLine[] {
  const rows: OutlineLine[] = [];
  const visit = (id: NodeId, depth: number, isDraft: boolean): void => {
    const node = diagram.nodes[id];
    if (!node) return;
    const children = childrenOf(diagram, id);
    const isFolded = node.collapsed === true && children.length > 0;
    rows.push({ id, depth, hasChildren: children.length > 0, isFolded, isDraft });
    if (!isFolded) for (const child of children) visit(child, depth + 1, false);
  };
  for (const top of topsOf(diagram)) visit(top, 0, top !== diagram.root);
  return rows;
}
