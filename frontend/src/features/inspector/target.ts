import type { Diagram, DiagramNode, NodeId } from '@/model/diagram';
import type { NodeSpec } from '@/model/vocabulary';

/** The block that the inspector shows. */
export interface Target {
  readonly diagram: Diagram;
  readonly tree: string;
  readonly id: NodeId;
  readonly node: DiagramNode;
  /** Absent if the type is unknown. */
  readonly spec: NodeSpec | undefined;
}
