import { displayName, preorder, type Diagram, type NodeId } from './diagram';

/** Returns the nodes whose name, type, ports, conditions or comment contain the text, in execution order. */
export function findNodes(diagram: Diagram, text: string): NodeId[] {
  const wanted = text.trim().toLowerCase();
  if (wanted === '') return [];
  return preorder(diagram).filter((id) => {
    const node = diagram.nodes[id];
    if (!node) return false;
    const words = [
      displayName(node),
      node.type,
      node.comment ?? '',
      ...Object.entries(node.ports ?? {}).flat(),
      ...Object.entries(node.conditions ?? {}).flat(),
    ];
    return words.some((word) => word.toLowerCase().includes(wanted));
  });
}
