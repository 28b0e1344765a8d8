import type { Diagram, NodeId } from '../diagram';
import { readPortText } from '../ports';
import { hasAutoremap, passedFor } from './scope';

/** A SubTree of a running tree that encloses a node: its path, and its block. */
export interface Enclosing {
  readonly path: string;
  readonly tree: string;
  readonly node: NodeId;
}

/** An entry of the running blackboard. */
export interface EntryId {
  readonly scope: string;
  readonly key: string;
}

export interface RunningBoard {
  readonly diagrams: Readonly<Record<string, Diagram>>;
  has(entry: EntryId): boolean;
}

/** Returns the key that a port's text refers to, with `@` before a shared key; null if it refers to none. */
export function keyIn(text: string, port: string): string | null {
  const value = readPortText(text);
  if (value.kind === 'same-name') return port;
  if (value.kind !== 'key') return null;
  return value.global ? `@${value.key}` : value.key;
}

/**
 * Returns the name that a key of a called tree has in the tree of the caller; null if the SubTree does not
 * pass it.
 */
function keyOutside(key: string, caller: Enclosing, diagrams: RunningBoard['diagrams']): string | null {
  const node = diagrams[caller.tree]?.nodes[caller.node];
  if (!node) return null;
  const text = passedFor(node, key, diagrams[node.tree ?? '']);
  if (text === undefined) return hasAutoremap(node) && !key.startsWith('_') ? key : null;
  return keyIn(text, key);
}

/**
 * Finds the entry that a key refers to at a node of the running tree. As in the engine, the scope of the
 * node's own tree comes first, and then each SubTree around it that passes the key, from the innermost
 * outwards.
 */
export function findEntry(key: string, callers: readonly Enclosing[], board: RunningBoard): EntryId | null {
  let name: string | null = key;
  for (let depth = 0; name !== null && depth <= callers.length; depth += 1) {
    if (name.startsWith('@')) {
      name = name.slice(1);
      depth = callers.length;
    }
    const caller: Enclosing | undefined = callers[depth];
    const entry = { scope: caller?.path ?? '', key: name };
    if (board.has(entry)) return entry;
    name = caller ? keyOutside(name, caller, board.diagrams) : null;
  }
  return null;
}
