import type { Draft } from 'immer';
import type { Diagram, DiagramNode } from '../diagram';
import { serializeDiagram } from '../serialize';
import type { Recipe } from './core';

/** Returns a node's text in the saved format, which does not depend on the order of its fields. */
function textOf(node: DiagramNode): string {
  const diagram = { id: '', root: 'n', nodes: { n: { ...node, children: [] } }, drafts: [] };
  return serializeDiagram({ format: 'bt-studio/diagram', version: 1, layout: 'vertical', ...diagram });
}

const sameList = (a: readonly string[] = [], b: readonly string[] = []): boolean =>
  a.length === b.length && a.every((item, index) => item === b[index]);

/** Returns whether two nodes are equal, children included. */
export function sameNode(a: DiagramNode, b: DiagramNode): boolean {
  return a === b || (sameList(a.children, b.children) && textOf(a) === textOf(b));
}

/**
 * Changes a tree into another one. It touches only the differences, so that unchanged blocks are not drawn
 * again.
 */
export const become =
  (next: Diagram): Recipe =>
  (draft) => {
    for (const id of Object.keys(draft.nodes)) if (!(id in next.nodes)) delete draft.nodes[id];
    for (const [id, node] of Object.entries(next.nodes)) {
      const now = draft.nodes[id];
      if (!now || !sameNode(now as DiagramNode, node)) draft.nodes[id] = node as Draft<DiagramNode>;
    }
    const { nodes: _nodes, ...rest } = next;
    const fields = draft as unknown as Record<string, unknown>;
    for (const key of Object.keys(draft)) if (!(key in next)) delete fields[key];
    for (const [key, value] of Object.entries(rest)) {
      if (JSON.stringify(fields[key]) !== JSON.stringify(value)) fields[key] = value;
    }
  };
