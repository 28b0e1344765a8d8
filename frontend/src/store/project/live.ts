import { create } from 'zustand';
import type { NodeStatus, TreeNode } from '@/generated/messages';

/** `<tree>/<node>`, since node ids are unique only within their diagram. */
export type LiveKey = string;

export const liveKey = (tree: string, node: string): LiveKey => `${tree}/${node}`;

interface Flash {
  readonly status: NodeStatus;
  /** Increases with each flash, so that repeating the same flash starts its animation again. */
  readonly count: number;
  readonly since: number;
}

/**
 * The shortest time between two flash animations of a node. It is shorter than the animation, so that a node
 * that flashes often stays lit.
 */
const REFLASH_MS = 350;

export interface LiveState {
  /** Whether a tree is running, or its last statuses are still shown. */
  readonly active: boolean;
  readonly statuses: ReadonlyMap<LiveKey, NodeStatus>;
  /** The last statuses of blocks that were active in the last tick and are idle again. */
  readonly past: ReadonlyMap<LiveKey, NodeStatus>;
  readonly flashes: ReadonlyMap<LiveKey, Flash>;
  readonly faults: ReadonlyMap<LiveKey, string>;
  setTree(nodes: readonly TreeNode[]): void;
  setStatuses(changed: readonly (readonly [uid: number, status: NodeStatus])[]): void;
  /** Returns the status of each node that has changed since the tree began. */
  uidStatuses(): ReadonlyMap<number, NodeStatus>;
  /** Replaces the statuses of the last tick. */
  setPast(past: readonly (readonly [uid: number, status: NodeStatus])[]): void;
  flash(flashed: readonly (readonly [uid: number, status: NodeStatus])[]): void;
  setFault(node: string, tree: string, message: string): void;
  clear(): void;
}

/**
 * The rank of each status. A tree that is called twice has two instances of each node, and a block shows the
 * one of the highest rank.
 */
const WEIGHT: Record<NodeStatus, number> = { RUNNING: 4, FAILURE: 3, SUCCESS: 2, SKIPPED: 1, IDLE: 0 };

const busiest = (statuses: readonly NodeStatus[]): NodeStatus =>
  statuses.reduce<NodeStatus>((best, next) => (WEIGHT[next] > WEIGHT[best] ? next : best), 'IDLE');

/** The statuses of the running tree; they are neither saved nor undone. */
export const useLiveStore = liveStore();

/** The statuses of the tree at the shown past moment. */
export const usePastLive = liveStore();

function liveStore() {
  return create<LiveState>()((set, get) => {
    let keys = new Map<number, LiveKey>();
    let instances = new Map<LiveKey, number[]>();
    let byUid = new Map<number, NodeStatus>();
    let flashCount = 0;

    const merged = (key: LiveKey): NodeStatus =>
      busiest((instances.get(key) ?? []).map((uid) => byUid.get(uid) ?? 'IDLE'));

    return {
      active: false,
      statuses: new Map(),
      past: new Map(),
      flashes: new Map(),
      faults: new Map(),
      setTree: (nodes) => {
        keys = new Map();
        instances = new Map();
        byUid = new Map();
        for (const node of nodes) {
          if (!node.node_id) continue;
          const key = liveKey(node.tree_id, node.node_id);
          keys.set(node.uid, key);
          instances.set(key, [...(instances.get(key) ?? []), node.uid]);
        }
        set({ active: true, ...nothing() });
      },
      setStatuses: (changed) => {
        if (changed.length === 0) return;
        const statuses = new Map(get().statuses);
        for (const [uid, status] of changed) {
          byUid.set(uid, status);
          const key = keys.get(uid);
          if (key !== undefined) statuses.set(key, merged(key));
        }
        set({ statuses });
      },
      uidStatuses: () => byUid,
      setPast: (pairs) => {
        const past = new Map<LiveKey, NodeStatus>();
        for (const [uid, status] of pairs) {
          const key = keys.get(uid);
          if (key !== undefined) past.set(key, busiest([past.get(key) ?? 'IDLE', status]));
        }
        // Most ticks end like the previous one, and then nothing needs to be drawn again.
        if (!isEqual(past, get().past)) set({ past });
      },
      flash: (flashed) => {
        const now = performance.now();
        const before = get().flashes;
        const flashes = new Map(before);
        let changed = false;
        for (const [uid, status] of flashed) {
          const key = keys.get(uid);
          if (key === undefined) continue;
          const last = before.get(key);
          if (last?.status === status && now - last.since < REFLASH_MS) continue;
          flashes.set(key, { status, count: (flashCount += 1), since: now });
          changed = true;
        }
        if (changed) set({ flashes });
      },
      setFault: (node, tree, message) => {
        set((state) => ({ faults: new Map(state.faults).set(liveKey(tree, node), message) }));
      },
      clear: () => {
        keys = new Map();
        byUid = new Map();
        set({ active: false, ...nothing() });
      },
    };
  });
}

const nothing = () => ({ statuses: new Map(), past: new Map(), flashes: new Map(), faults: new Map() });

function isEqual(a: ReadonlyMap<LiveKey, NodeStatus>, b: ReadonlyMap<LiveKey, NodeStatus>): boolean {
  return a.size === b.size && [...a].every(([key, status]) => b.get(key) === status);
}

/** Returns a block's status in the last tick if the block is idle again. */
export function pastOf({ statuses, past }: LiveState, key: LiveKey): NodeStatus | undefined {
  return (statuses.get(key) ?? 'IDLE') === 'IDLE' ? past.get(key) : undefined;
}
