import type { NodeStatus, TreeNode } from '@/generated/messages';
import { BIT, type Stretch } from '@/store/session/trace/nodeTrace';

export interface TimelineRow {
  uid: number;
  name: string;
  type: string;
  depth: number;
  node: string;
  tree: string;
}

/**
 * Returns the name of a node without the number that the engine adds for unnamed nodes (`Forward::6`), or its
 * type.
 */
export const plainName = (node: Pick<TreeNode, 'name' | 'type'>) =>
  node.name.replace(/::\d+$/, '') || node.type;

/** Returns the nodes of the running tree in order; with a search, only those whose name or type matches. */
export function rowsOf(nodes: readonly TreeNode[], search: string): TimelineRow[] {
  const depths = new Map<number, number>();
  const wanted = search.trim().toLowerCase();
  const rows: TimelineRow[] = [];
  for (const node of nodes) {
    const depth = (depths.get(node.parent) ?? -1) + 1;
    depths.set(node.uid, depth);
    const name = plainName(node);
    if (wanted && !`${name} ${node.type}`.toLowerCase().includes(wanted)) continue;
    rows.push({
      uid: node.uid,
      name,
      type: node.type,
      depth: wanted ? 0 : depth,
      node: node.node_id,
      tree: node.tree_id,
    });
  }
  return rows;
}

const ORDER: NodeStatus[] = ['FAILURE', 'SUCCESS', 'RUNNING', 'SKIPPED'];

/** Returns the statuses in a stretch, the most important first. */
export function statusesOf({ mask }: Stretch): NodeStatus[] {
  return ORDER.filter((status) => (mask & BIT[status]) !== 0);
}
