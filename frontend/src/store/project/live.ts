import { create } from 'zustand';
import type { NodeStatus, TreeNode } from '@/generated/messages';

/** `<tree>/<node>`, since node ids are unique only within their diagram. */
export type LiveKey = string;

export const liveKey = (tree: string, node: string): LiveKey => `${tree}/${node}`;

export interface Flash {
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

type Pairs = readonly (readonly [uid: number, status: NodeStatus])[];

/** The state of a tree at a past moment. */
export interface MomentOfTree {
  /** The nodes that are not idle. */
  readonly statuses: Pairs;
  /** Results within the last tick that did not stay. */
  readonly flashed: Pairs;
  /** The last tick itself, if the tree was halted after it: its statuses are shown as past ones. */
  readonly halted: { readonly statuses: Pairs; readonly flashes: Pairs } | null;
  /** The faults up to the moment, by uid. */
  readonly faults: readonly (readonly [uid: number, message: string])[];
}

export interface LiveState {
  /** Whether a tree is running, or its last statuses are still shown. */
  readonly active: boolean;
  readonly statuses: ReadonlyMap<LiveKey, NodeStatus>;
  /** The last statuses of blocks that were active in the last tick and are idle again. */
  readonly past: ReadonlyMap<LiveKey, NodeStatus>;
  readonly flashes: ReadonlyMap<LiveKey, Flash>;
  readonly faults: ReadonlyMap<LiveKey, string>;
  setTree(nodes: readonly TreeNode[]): void;
  setStatuses(changed: Pairs): void;
  /** Returns the status of each node that has changed since the tree began. */
  uidStatuses(): ReadonlyMap<number, NodeStatus>;
  /** Replaces the statuses of the last tick. */
  setPast(past: Pairs): void;
  flash(flashed: Pairs): void;
  /** Replaces everything by the state of a moment, at once, so that each block is drawn at most once. */
  setMoment(moment: MomentOfTree): void;
  setFault(node: string, tree: string, message: string): void;
  clear(): void;
}

/**
 * The rank of each status. A tree that is called twice has two instances of each node, and a block shows the
 * one of the highest rank.
 */
const WEIGHT: Record<NodeStatus, number> = { RUNNING: 4, FAILURE: 3, SUCCESS: 2, SKIPPED: 1, IDLE: 0 };

/** Returns the status of the highest rank. */
export const busiest = (statuses: readonly NodeStatus[]): NodeStatus =>
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

    const pastBy = (pairs: Pairs): Map<LiveKey, NodeStatus> => {
      const past = new Map<LiveKey, NodeStatus>();
      for (const [uid, status] of pairs) put(past, uid, (key) => busiest([past.get(key) ?? 'IDLE', status]));
      return past;
    };

    /** Sets the value of the block that a node belongs to. */
    function put<T>(map: Map<LiveKey, T>, uid: number, value: (key: LiveKey) => T): void {
      const key = keys.get(uid);
      if (key !== undefined) map.set(key, value(key));
    }

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
        const past = pastBy(pairs);
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
      setMoment: ({ statuses: active, flashed, halted, faults: messages }) => {
        byUid = new Map(active);
        const before = get();
        const statuses = new Map<LiveKey, NodeStatus>();
        for (const [uid] of active) put(statuses, uid, merged);
        // A result is later than the status that the node had when the tick began.
        const last = new Map([...(halted?.statuses ?? []), ...(halted?.flashes ?? []), ...flashed]);
        const idle = [...last].filter(([uid]) => !byUid.has(uid));
        const others = flashed.filter(([uid]) => byUid.has(uid));
        const flashes = new Map<LiveKey, Flash>();
        for (const [uid, status] of others) {
          put(flashes, uid, (key) => {
            const last = before.flashes.get(key);
            return last?.status === status ? last : { status, count: (flashCount += 1), since: 0 };
          });
        }
        const faults = new Map<LiveKey, string>();
        for (const [uid, message] of messages) put(faults, uid, () => message);
        set({
          statuses,
          past: same(before.past, pastBy(idle)),
          flashes: same(before.flashes, flashes),
          faults: same(before.faults, faults),
        });
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

function isEqual<T>(a: ReadonlyMap<LiveKey, T>, b: ReadonlyMap<LiveKey, T>): boolean {
  return a.size === b.size && [...a].every(([key, value]) => b.get(key) === value);
}

/** Returns the map from before if the new one holds the same. */
const same = <T>(before: ReadonlyMap<LiveKey, T>, now: ReadonlyMap<LiveKey, T>): ReadonlyMap<LiveKey, T> =>
  isEqual(before, now) ? before : now;

/** Returns a block's status in the last tick if the block is idle again. */
export function pastOf({ statuses, past }: LiveState, key: LiveKey): NodeStatus | undefined {
  return (statuses.get(key) ?? 'IDLE') === 'IDLE' ? past.get(key) : undefined;
}
