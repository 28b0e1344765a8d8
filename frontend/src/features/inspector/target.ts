import type { Diagram, DiagramNode, NodeId } from '@/model/diagram';
import { specOf, type NodeSpec, type Vocabulary } from '@/model/vocabulary';

/** The block that the inspector shows. */
export interface Target {
  readonly diagram: Diagram;
  readonly tree: string;
  readonly id: NodeId;
  readonly node: DiagramNode;
  /** Absent if the type is unknown. */
  readonly spec: NodeSpec | undefined;
}

/** Returns the block with the description of its type; null if there is no such block. */
export function targetOf(
  diagram: Diagram | undefined,
  id: NodeId | undefined,
  vocabulary: Vocabulary,
): Target | null {
  const node = id === undefined ? undefined : diagram?.nodes[id];
  if (!diagram || id === undefined || !node) return null;
  return { diagram, tree: diagram.id, id, node, spec: specOf(vocabulary, node) };
}
