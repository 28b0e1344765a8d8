import type { Breakpoint, ResultName } from '@/generated/messages';
import type { Diagram } from './diagram';

/** A breakpoint on a block, as it is kept and as it is sent to the session. */
export type BlockBreakpoint = Breakpoint;

/** The results that a breakpoint can wait for, and that can be forced. */
export const RESULTS: readonly ResultName[] = ['SUCCESS', 'FAILURE', 'RUNNING', 'SKIPPED'];
/** The moments at which a breakpoint can hold the tree. */
export const MOMENTS = ['before', 'after', 'returns', 'halted'] as const;
/** The most breakpoints that a session takes. */
export const MOST_BREAKPOINTS = 500;

type Diagrams = Readonly<Record<string, Diagram>>;

/** Returns a breakpoint before the ticks of a block, in all instances of its tree. */
export const plainBreakpoint = (tree: string, node: string): BlockBreakpoint => ({
  tree_id: tree,
  node_id: node,
  instance: null,
  when: 'before',
  status: null,
  condition: '',
  hits: 1,
  log: '',
  on: true,
});

export const isOn = (each: BlockBreakpoint, tree: string, node: string): boolean =>
  each.tree_id === tree && each.node_id === node;

/** Returns the breakpoints with one more on a block, or without the one that it has. */
export function toggled(list: readonly BlockBreakpoint[], tree: string, node: string): BlockBreakpoint[] {
  const others = list.filter((each) => !isOn(each, tree, node));
  return others.length < list.length ? others : [...others, plainBreakpoint(tree, node)];
}

/** Returns the breakpoints with a change to the one of a block. */
export function changed(
  list: readonly BlockBreakpoint[],
  tree: string,
  node: string,
  change: Partial<BlockBreakpoint>,
): BlockBreakpoint[] {
  return list.map((each) => {
    if (!isOn(each, tree, node)) return each;
    const next = { ...each, ...change };
    return { ...next, status: next.when === 'returns' ? (next.status ?? 'FAILURE') : null };
  });
}

/** Returns the breakpoints whose blocks exist. */
export const existing = (list: readonly BlockBreakpoint[], diagrams: Diagrams): readonly BlockBreakpoint[] =>
  list.filter((each) => diagrams[each.tree_id]?.nodes[each.node_id]);

/**
 * Returns the breakpoints after an edit: a block that is moved to another tree keeps its breakpoint. That of
 * a deleted block stays in the list, so that *undo* brings it back with the block; ids are never used again.
 * `before` and `after` are the trees by id.
 */
export function followed(
  list: readonly BlockBreakpoint[],
  before: Diagrams,
  after: Diagrams,
): readonly BlockBreakpoint[] {
  const next = list.map((each) => {
    if (after[each.tree_id]?.nodes[each.node_id]) return each;
    const home = Object.values(after).find(
      ({ id, nodes }) => nodes[each.node_id] && !before[id]?.nodes[each.node_id],
    );
    return home ? { ...each, tree_id: home.id, instance: null } : each;
  });
  return next.every((each, at) => each === list[at]) ? list : next;
}

/** Returns the breakpoints that a stored text has; those that are damaged are left out. */
export function readBreakpoints(stored: unknown): BlockBreakpoint[] {
  if (!Array.isArray(stored)) return [];
  return stored.flatMap((each: unknown) => {
    const read = readBreakpoint(each);
    return read ? [read] : [];
  });
}

const text = (value: unknown): string => (typeof value === 'string' ? value.slice(0, 1000) : '');

function readBreakpoint(stored: unknown): BlockBreakpoint | null {
  if (typeof stored !== 'object' || stored === null) return null;
  const { tree_id, node_id, instance, when, status, condition, hits, log, on } = stored as Record<
    string,
    unknown
  >;
  if (typeof tree_id !== 'string' || typeof node_id !== 'string' || !tree_id || !node_id) return null;
  const moment = MOMENTS.find((each) => each === when) ?? 'before';
  const areKeys = (keys: unknown[]): keys is string[] => keys.every((key) => typeof key === 'string' && key);
  return {
    tree_id,
    node_id,
    instance: Array.isArray(instance) && areKeys(instance) ? instance : null,
    when: moment,
    status: moment === 'returns' ? (RESULTS.find((each) => each === status) ?? 'FAILURE') : null,
    condition: text(condition),
    hits: typeof hits === 'number' && Number.isInteger(hits) && hits >= 1 && hits <= 1_000_000 ? hits : 1,
    log: text(log),
    on: on !== false,
  };
}
