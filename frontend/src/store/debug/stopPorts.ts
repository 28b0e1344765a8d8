import type { TreeNode } from '@/generated/messages';
import { findEntry, keyIn } from '@/model/keys/entry';
import { specOf } from '@/model/vocabulary';
import { useProjectStore } from '@/store/project';
import { blackboardId } from '@/store/session/reduce';
import { enclosing } from '@/store/session/values/live';
import type { SessionData } from '@/store/session/types';

/** A port of a held node: its text, and for a blackboard key the value that it has now. */
export interface StopPort {
  readonly name: string;
  readonly text: string;
  /** null for a literal. */
  readonly key: string | null;
  /** Whether the key has an entry. */
  readonly isSet: boolean;
  readonly value: unknown;
}

/** Returns the ports of a node of the running tree with their values at this moment. */
export function portsOf(node: TreeNode, session: Pick<SessionData, 'tree' | 'blackboard'>): StopPort[] {
  const { diagrams, vocabulary } = useProjectStore.getState();
  const block = diagrams[node.tree_id]?.nodes[node.node_id];
  if (!block) return [];
  const texts = new Map<string, string>();
  for (const { name, default: text } of specOf(vocabulary, block)?.ports ?? []) {
    if (text !== null) texts.set(name, text);
  }
  for (const [name, text] of Object.entries(block.ports ?? {})) texts.set(name, text);
  const callers = enclosing(node, new Map(session.tree.map((each) => [each.uid, each])));
  const rows = session.blackboard;
  return [...texts].map(([name, text]) => {
    const key = keyIn(text, name);
    const board = { diagrams, has: (each: { scope: string; key: string }) => blackboardId(each) in rows };
    const entry = key === null ? null : findEntry(key, callers, board);
    const row = entry && rows[blackboardId(entry)];
    return { name, text, key, isSet: Boolean(row), value: row ? row.value : text };
  });
}
