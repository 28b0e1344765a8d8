import { childrenOf, parentOf, subtreeOf, topsOf, type Diagram, type NodeId } from './diagram';
import { hasRoom } from './rules';
import type { Vocabulary } from './vocabulary';

/** One line of the outline. */
export interface OutlineLine {
  readonly id: NodeId;
  readonly depth: number;
  readonly hasChildren: boolean;
  readonly isFolded: boolean;
  readonly isDraft: boolean;
}

/** Returns all visible lines in execution order; a folded node hides the lines below it. */
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

/** A place between or on the lines where dragged lines may be dropped. */
export interface OutlineSlot {
  readonly parent: NodeId;
  /** The index among the children before the drop. */
  readonly index: number;
  /**
   * The line that shows the mark; `edge` says whether the mark is at its upper or lower edge, or on all of
   * it.
   */
  readonly row: NodeId;
  readonly edge: 'before' | 'after' | 'onto';
}

/** The part of a line's height, at its upper and lower edge, where a drop means before and after it. */
const EDGE = 0.3;

interface Drop {
  readonly diagram: Diagram;
  readonly vocabulary: Vocabulary;
  /** The blocks that are moved, each with its subtree. */
  readonly moving: readonly NodeId[];
}

/**
 * Returns the slot at a line; `share` is the height within the line, from 0 to 1. A drop below a line with
 * visible children goes before the first of them. Null where the blocks may not be dropped.
 */
export function outlineSlot(
  { diagram, vocabulary, moving }: Drop,
  line: OutlineLine,
  share: number,
): OutlineSlot | null {
  const { id } = line;
  if (moving.some((top) => subtreeOf(diagram, top).includes(id))) return null;
  const leaving = new Set(moving);
  const accepts = (parent: NodeId): boolean => hasRoom(diagram, parent, vocabulary, moving.length, leaving);
  const onto = (): OutlineSlot | null =>
    accepts(id) ? { parent: id, index: childrenOf(diagram, id).length, row: id, edge: 'onto' } : null;
  const beside = (edge: 'before' | 'after'): OutlineSlot | null => {
    const parent = parentOf(diagram, id);
    if (parent === null || !accepts(parent)) return null;
    const at = childrenOf(diagram, parent).indexOf(id);
    return { parent, index: edge === 'before' ? at : at + 1, row: id, edge };
  };
  if (share >= EDGE && share <= 1 - EDGE) return onto() ?? beside(share < 0.5 ? 'before' : 'after');
  if (share < EDGE) return beside('before') ?? onto();
  if (!line.hasChildren || line.isFolded) return beside('after') ?? onto();
  return accepts(id) ? { parent: id, index: 0, row: id, edge: 'after' } : null;
}
