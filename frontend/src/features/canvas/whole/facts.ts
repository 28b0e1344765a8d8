import type { Diagram, DiagramNode, NodeId } from '@/model/diagram';
import type { Inside } from '@/model/expand';
import { specOf, type Family, type Vocabulary } from '@/model/vocabulary';
import { liveKey, type LiveKey } from '@/store/project/live';
import type { ShownProblem } from '@/store/project/problems';

/** What the picture of a whole tree knows of a block, drawn or hidden in a folded one. */
export interface Facts {
  readonly id: NodeId;
  readonly key: LiveKey;
  readonly node: DiagramNode;
  readonly family: Family | null;
  readonly hasError: boolean;
  readonly isSelected: boolean;
}

export type FactsOf = ReadonlyMap<NodeId, Facts>;

export interface FactsInput {
  /** The tree as it is drawn, with the trees that are looked into. */
  readonly diagram: Diagram;
  readonly inside: ReadonlyMap<NodeId, Inside>;
  readonly vocabulary: Vocabulary;
  readonly problems: ReadonlyMap<NodeId, ShownProblem>;
  readonly selection: ReadonlySet<NodeId>;
}

export function factsOf({ diagram, inside, vocabulary, problems, selection }: FactsInput): FactsOf {
  const facts = new Map<NodeId, Facts>();
  for (const [id, node] of Object.entries(diagram.nodes)) {
    const real = inside.get(id);
    facts.set(id, {
      id,
      key: real ? liveKey(real.tree, real.node) : liveKey(diagram.id, id),
      node,
      family: specOf(vocabulary, node)?.family ?? null,
      hasError: problems.get(id)?.severity === 'error',
      isSelected: selection.has(id),
    });
  }
  return facts;
}
