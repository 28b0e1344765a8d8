import type { NodeId } from '@/model/diagram';
import { setSilenced } from '@/model/edits';
import { useProjectStore } from '../index';

/** Leaves a finding out at a block, with the reason. */
export function silence(tree: string, node: NodeId, code: string, reason: string): void {
  useProjectStore.getState().apply(tree, 'silence', [setSilenced(node, code, reason)]);
}

/** Reports a finding again that was silenced at a block. */
export function unsilence(tree: string, node: NodeId, code: string): void {
  useProjectStore.getState().apply(tree, 'unsilence', [setSilenced(node, code, null)]);
}
