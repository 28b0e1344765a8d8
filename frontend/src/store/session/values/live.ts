import { create } from 'zustand';
import type { TreeNode } from '@/generated/messages';
import { findEntry, keyIn, type Enclosing } from '@/model/keys/entry';
import { specOf } from '@/model/vocabulary';
import { useProjectStore } from '@/store/project';
import { blackboardId } from '../reduce';
import type { BlackboardRow, SessionData } from '../types';
import { partsOf, useShownValues, type ShownPort } from './shown';

/** The value of a port's entry, with its last samples if it is a number. */
export interface LiveValue {
  readonly key: string;
  readonly value: unknown;
  readonly changedAt: number;
  readonly samples: readonly number[];
}

/** The shortest time in ms between two values of a block; 40 samples at this interval cover ten seconds. */
export const INTERVAL_MS = 250;
const MOST_SAMPLES = 40;

/**
 * The values of the ports that are shown in blocks: the current ones, or the last ones of a run that has
 * ended.
 */
export const useLiveValues = create<{ readonly values: ReadonlyMap<ShownPort, LiveValue> }>(() => ({
  values: new Map(),
}));

let takenAt = -Infinity;
let tree: readonly TreeNode[] | null = null;
let timer: ReturnType<typeof setTimeout> | undefined;

/** Returns the SubTrees around a node, the innermost first. */
export function enclosing(node: TreeNode, byUid: ReadonlyMap<number, TreeNode>): Enclosing[] {
  const found: Enclosing[] = [];
  for (let each = byUid.get(node.parent); each; each = byUid.get(each.parent)) {
    if (each.type === 'SubTree') found.push({ path: each.path, tree: each.tree_id, node: each.node_id });
  }
  return found;
}

/** Returns the entry of a port; for a tree that is called several times, the entry in its first call. */
function rowOf(shown: ShownPort, session: SessionData, byUid: ReadonlyMap<number, TreeNode>) {
  const { tree, node: id, port } = partsOf(shown);
  const { diagrams, vocabulary } = useProjectStore.getState();
  const node = diagrams[tree]?.nodes[id];
  const running = session.tree.find((each) => each.tree_id === tree && each.node_id === id);
  if (!node || !running) return null;
  const text =
    node.ports?.[port] ?? specOf(vocabulary, node)?.ports.find(({ name }) => name === port)?.default;
  const key = keyIn(text ?? '', port);
  const rows = session.blackboard;
  const entry =
    key !== null &&
    findEntry(key, enclosing(running, byUid), { diagrams, has: (each) => blackboardId(each) in rows });
  return entry ? (rows[blackboardId(entry)] ?? null) : null;
}

const numberOf = (value: unknown): number | null =>
  typeof value === 'boolean' ? Number(value) : typeof value === 'number' && isFinite(value) ? value : null;

function next(row: BlackboardRow, before: LiveValue | undefined, goesOn: boolean): LiveValue {
  const { key, value, changedAt } = row;
  const isSame = before?.changedAt === changedAt && before.key === key;
  // No samples are taken while time is paused.
  if (isSame && !goesOn) return before;
  const number = numberOf(value);
  const earlier = before?.key === key ? before.samples : [];
  return {
    key,
    value,
    changedAt,
    samples: number === null ? [] : [...earlier, number].slice(-MOST_SAMPLES),
  };
}

function take(session: SessionData, now: number): void {
  clearTimeout(timer);
  timer = undefined;
  takenAt = now;
  const { values } = useLiveValues.getState();
  // A new tree means a new run, so the samples start empty.
  const before = session.tree === tree ? values : new Map<ShownPort, LiveValue>();
  tree = session.tree;
  const byUid = new Map(session.tree.map((node) => [node.uid, node]));
  const taken = new Map<ShownPort, LiveValue>();
  for (const shown of useShownValues.getState().ports) {
    const row = rowOf(shown, session, byUid);
    const goesOn = session.executor === 'application_running';
    if (row) taken.set(shown, next(row, before.get(shown), goesOn));
  }
  if (taken.size > 0 || values.size > 0) useLiveValues.setState({ values: taken });
}

/** Returns the values at a past moment of the session, without samples. */
export function valuesAt(session: SessionData): ReadonlyMap<ShownPort, LiveValue> {
  const byUid = new Map(session.tree.map((node) => [node.uid, node]));
  const found = new Map<ShownPort, LiveValue>();
  for (const shown of useShownValues.getState().ports) {
    const row = rowOf(shown, session, byUid);
    if (row) found.set(shown, { key: row.key, value: row.value, changedAt: row.changedAt, samples: [] });
  }
  return found;
}

/** Updates the values after a batch of messages, now or when the next update is due. */
export function feedValues(read: () => SessionData): void {
  if (useShownValues.getState().ports.size === 0 && useLiveValues.getState().values.size === 0) return;
  const now = performance.now();
  const wait = takenAt + INTERVAL_MS - now;
  if (wait <= 0) take(read(), now);
  else
    timer ??= setTimeout(() => {
      take(read(), performance.now());
    }, wait);
}

/** Clears the values of a session that has ended. */
export function forgetValues(): void {
  clearTimeout(timer);
  timer = undefined;
  takenAt = -Infinity;
  tree = null;
  useLiveValues.setState({ values: new Map() });
}
