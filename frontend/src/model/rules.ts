import { childrenOf, isWithin, parentOf, type Diagram, type NodeId } from './diagram';
import { specOf, wouldRecurse, type NodeSpec, type Vocabulary } from './vocabulary';

/** The kind of a new block: a type, and for a `SubTree` its tree. */
export interface Kind {
  readonly type: string;
  readonly tree?: string;
}

/**
 * Returns the number of children that a node may have; a node of unknown type may keep its children, but gets
 * no more.
 */
function capacity(diagram: Diagram, id: NodeId, vocabulary: Vocabulary): number {
  const node = diagram.nodes[id];
  if (!node) return 0;
  return specOf(vocabulary, node)?.maxChildren ?? childrenOf(diagram, id).length;
}

const NONE: ReadonlySet<NodeId> = new Set();

/** Returns whether this many more children fit under `id` after those in `leaving` have left it. */
export function hasRoom(
  diagram: Diagram,
  id: NodeId,
  vocabulary: Vocabulary,
  count: number,
  leaving: ReadonlySet<NodeId> = NONE,
): boolean {
  const children = childrenOf(diagram, id);
  const staying = leaving.size === 0 ? children : children.filter((child) => !leaving.has(child));
  return staying.length + count <= capacity(diagram, id, vocabulary);
}

/** Returns whether `id` can have one more child; `moving` is a child of it that only changes its place. */
export function acceptsChild(diagram: Diagram, id: NodeId, vocabulary: Vocabulary, moving?: NodeId): boolean {
  return hasRoom(diagram, id, vocabulary, 1, moving === undefined ? NONE : new Set([moving]));
}

/** Returns whether `id` with its subtree may be moved under `parent`. */
export function canMoveUnder(diagram: Diagram, id: NodeId, parent: NodeId, vocabulary: Vocabulary): boolean {
  return (
    id in diagram.nodes && !isWithin(diagram, parent, id) && acceptsChild(diagram, parent, vocabulary, id)
  );
}

/** Returns whether a block of this kind may be in this tree at all. */
export function isKindLegal(diagram: Pick<Diagram, 'id'>, kind: Kind, vocabulary: Vocabulary): boolean {
  return !(kind.type === 'SubTree' && kind.tree && wouldRecurse(vocabulary, diagram.id, kind.tree));
}

/** Returns whether a node may change to this type with its present children. */
export function canMorph(diagram: Diagram, id: NodeId, spec: NodeSpec): boolean {
  const count = childrenOf(diagram, id).length;
  return count <= spec.maxChildren;
}

/** Returns whether a new node of this type may be inserted between a node and its parent. */
export function canWrapIn(spec: NodeSpec): boolean {
  return spec.maxChildren > 0;
}

/** Returns whether a node can be removed alone: its children must have a legal place then. */
export function canUnwrap(diagram: Diagram, id: NodeId, vocabulary: Vocabulary): boolean {
  const count = childrenOf(diagram, id).length;
  if (count === 0) return false;
  const parent = parentOf(diagram, id);
  if (parent === null) return true;
  return childrenOf(diagram, parent).length - 1 + count <= capacity(diagram, parent, vocabulary);
}

/**
 * The place of a block: at the root, under a parent, as a draft, or after a block that has no parent with room:
 * then a new Sequence takes the place of that block, and holds both.
 */
export type Placement =
  | { readonly at: 'root' }
  | { readonly at: 'child'; readonly parent: NodeId; readonly index: number }
  | { readonly at: 'beside'; readonly node: NodeId }
  | { readonly at: 'draft'; readonly position?: readonly [number, number] };

export function bestPlacement(
  diagram: Diagram,
  selected: NodeId | undefined,
  vocabulary: Vocabulary,
): Placement {
  if (diagram.root === null) return { at: 'root' };
  for (const start of [selected, diagram.root]) {
    for (let id: NodeId | null = start ?? null, below: NodeId | null = null; id !== null;) {
      if (id in diagram.nodes && acceptsChild(diagram, id, vocabulary)) {
        const children = childrenOf(diagram, id);
        const index = below === null ? children.length : children.indexOf(below) + 1;
        return { at: 'child', parent: id, index };
      }
      below = id;
      id = parentOf(diagram, id);
    }
  }
  return {
    at: 'beside',
    node: selected !== undefined && selected in diagram.nodes ? selected : diagram.root,
  };
}
