import type { Diagram, DiagramNode, NodeId } from './diagram';

type Diagrams = Readonly<Record<string, Diagram>>;

/** A port whose text differs between two states of the trees; null: the port has no text. */
export interface PortChange {
  readonly tree: string;
  readonly node: NodeId;
  readonly port: string;
  readonly before: string | null;
  readonly value: string | null;
}

function changesOf(before: DiagramNode, now: DiagramNode): Pick<PortChange, 'port' | 'before' | 'value'>[] {
  const [old, fresh] = [before.ports ?? {}, now.ports ?? {}];
  if (old === fresh || before.type !== now.type) return [];
  return [...new Set([...Object.keys(old), ...Object.keys(fresh)])]
    .filter((port) => old[port] !== fresh[port])
    .map((port) => ({ port, before: old[port] ?? null, value: fresh[port] ?? null }));
}

/** Returns the ports that differ, for blocks that have the same type in both states. */
export function portChanges(before: Diagrams, now: Diagrams): PortChange[] {
  return Object.entries(now).flatMap(([tree, diagram]) => {
    const other = before[tree];
    if (other === undefined || other === diagram) return [];
    return Object.entries(diagram.nodes).flatMap(([node, block]) => {
      const old = other.nodes[node];
      if (old === undefined || old === block) return [];
      return changesOf(old, block).map((change) => ({ tree, node, ...change }));
    });
  });
}

function withPort(block: DiagramNode, port: string, value: string | null): DiagramNode {
  const { [port]: _gone, ...others } = block.ports ?? {};
  return { ...block, ports: value === null ? others : { ...others, [port]: value } };
}

/** Returns the trees with the new texts of these changes. */
export function withPorts(diagrams: Diagrams, changes: readonly PortChange[]): Diagrams {
  return changes.reduce<Diagrams>((trees, { tree, node, port, value }) => {
    const diagram = trees[tree];
    const block = diagram?.nodes[node];
    if (!diagram || !block) return trees;
    const nodes = { ...diagram.nodes, [node]: withPort(block, port, value) };
    return { ...trees, [tree]: { ...diagram, nodes } };
  }, diagrams);
}

function isSame<T extends object>(a: T, b: T, but: keyof T): boolean {
  const keys = new Set([...Object.keys(a), ...Object.keys(b)] as (keyof T)[]);
  return [...keys].every((key) => key === but || a[key] === b[key]);
}

/**
 * Returns whether two states of the trees differ only in the ports of blocks. Equal parts must be identical
 * objects.
 */
export function differInPortsOnly(a: Diagrams, b: Diagrams): boolean {
  if (Object.keys(a).length !== Object.keys(b).length) return false;
  return Object.entries(a).every(([tree, one]) => {
    const other = b[tree];
    if (one === other) return true;
    if (other === undefined || !isSame(one, other, 'nodes')) return false;
    const blocks = Object.entries(one.nodes);
    return (
      blocks.length === Object.keys(other.nodes).length &&
      blocks.every(([id, block]) => {
        const twin = other.nodes[id];
        return twin === block || (twin !== undefined && isSame(block, twin, 'ports'));
      })
    );
  });
}
