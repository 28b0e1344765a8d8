import type { NodeTime } from '@/generated/messages';
import type { Fields } from './cdr';
import type { RecordedNode } from './types';

/** The times of nodes in the ticks of one message of `/bt/profile`, which ends at `t`. */
export interface ProfileRow {
  readonly t: number;
  readonly generation: number;
  readonly ticks: number;
  readonly nodes: readonly NodeTime[];
}

/** The times of nodes in a part of a run, and the tree that they belong to. */
export interface ProfileSum {
  readonly ticks: number;
  /** The time of the root, in ms. */
  readonly tick_ms: number;
  readonly nodes: readonly NodeTime[];
  readonly tree: readonly RecordedNode[];
}

const numbers = (value: unknown): ArrayLike<number> => (value ?? []) as ArrayLike<number>;

/** Returns a message of the recording. */
export function profileRow(t: number, fields: Fields): ProfileRow {
  const [calls, totals, selves] = ['calls', 'total_ms', 'self_ms'].map((name) => numbers(fields[name]));
  const nodes = Array.from(numbers(fields['uid']), (uid, at) => ({
    uid,
    calls: calls?.[at] ?? 0,
    total_ms: totals?.[at] ?? 0,
    self_ms: selves?.[at] ?? 0,
  }));
  return { t, generation: Number(fields['generation']), ticks: Number(fields['ticks']), nodes };
}

/**
 * Returns the sum of the messages that end in a part of a run; of several trees, those of the last one.
 *
 * @param treeOf returns the nodes of a generation.
 */
export function profileSum(
  rows: readonly ProfileRow[],
  from: number,
  to: number,
  treeOf: (generation: number) => readonly RecordedNode[],
): ProfileSum {
  const within = rows.filter(({ t }) => t > from && t <= to);
  const generation = within.at(-1)?.generation ?? -1;
  const sums = new Map<number, NodeTime>();
  let ticks = 0;
  for (const row of within) {
    if (row.generation !== generation) continue;
    ticks += row.ticks;
    for (const { uid, calls, total_ms, self_ms } of row.nodes) {
      const sum = sums.get(uid) ?? { uid, calls: 0, total_ms: 0, self_ms: 0 };
      sums.set(uid, {
        uid,
        calls: sum.calls + calls,
        total_ms: sum.total_ms + total_ms,
        self_ms: sum.self_ms + self_ms,
      });
    }
  }
  const tree = treeOf(generation);
  const nodes = [...sums.values()].sort((a, b) => a.uid - b.uid);
  return { ticks, tick_ms: sums.get(tree[0]?.uid ?? -1)?.total_ms ?? 0, nodes, tree };
}
