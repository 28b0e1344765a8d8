import type { Diagram, DiagramNode, NodeId } from '@/model/diagram';
import type { NodeSpec } from '@/model/vocabulary';

/** The block that the inspector shows. */
export interface Target {
  readonly diagram: Diagram;
  readonly tree: string;
  readonly id: NodeId;
  readonly node: DiagramNode;
  /** Absent of a type that nobody knows. */
  readonly spec: NodeSpec | undefined;
}
