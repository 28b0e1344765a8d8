import type { NodeStatus, TreeNode } from '@/generated/messages';
import { BIT, NodeTrace, type Stretch } from './nodeTrace';

/** The length of the timeline, in simulated seconds. */
export const HISTORY_S = 600;

/** The drawn length, in s, of a result that lasted for one tick only. */
const FLASH_S = 0.05;
const FORGET_EVERY_S = 20;
/**
 * The number of stretches that are kept over a reload, for all nodes together; it fits the browser's storage
 * limit.
 */
const KEPT_STRETCHES = 40_000;

interface Open {
  status: NodeStatus;
  since: number;
}

interface Kept {
  tree: string;
  begin: number;
  now: number;
  nodeTraces: [uid: number, stretches: number[]][];
}

/**
 * The statuses of each node over the last ten minutes. The data are outside of React: panels read them when
 * they draw.
 */
export class Trace {
  nodes: readonly TreeNode[] = [];
  /** The simulated times of the oldest and the newest data. */
  begin = 0;
  now = 0;
  /** Increases with each run. */
  run = 0;
  private nodeTraces = new Map<number, NodeTrace>();
  private open = new Map<number, Open>();
  private forgottenAt = 0;
  /** The end of the drawn results of the most recent tick that had any. */
  private resultsEnd = 0;

  /** @param lengthS how long the statuses are kept, in simulated seconds. */
  constructor(readonly lengthS = HISTORY_S) {}

  start(nodes: readonly TreeNode[], t: number): void {
    this.nodes = nodes;
    this.begin = t;
    this.now = t;
    this.forgottenAt = t;
    this.resultsEnd = t;
    this.run += 1;
    this.nodeTraces = new Map();
    this.open = new Map();
  }

  /** Continues with a changed tree in the same run: blocks that are in both keep what they did. */
  replace(nodes: readonly TreeNode[], t: number): void {
    this.advance(t);
    for (const uid of [...this.open.keys()]) this.change(uid, 'IDLE', t);
    const old = new Map([...keysOf(this.nodes)].map(([uid, key]) => [key, this.nodeTraces.get(uid)]));
    this.nodeTraces = new Map();
    for (const [uid, key] of keysOf(nodes)) {
      const kept = old.get(key);
      if (kept) this.nodeTraces.set(uid, kept);
    }
    this.nodes = nodes;
  }

  /** Adds the changes of a tick. */
  tick(
    changed: readonly (readonly [number, NodeStatus])[],
    flashed: readonly (readonly [number, NodeStatus])[],
    t: number,
  ): void {
    // Time went back because the world was reset: the times would overlap.
    if (t < this.now - 1) this.start(this.nodes, t);
    this.advance(t);
    for (const [uid, status] of flashed) this.addResult(uid, status, t);
    for (const [uid, status] of changed) this.change(uid, status, t);
  }

  advance(t: number): void {
    this.now = Math.max(this.now, t);
    if (this.now - this.forgottenAt < FORGET_EVERY_S) return;
    this.forgottenAt = this.now;
    const before = this.now - this.lengthS;
    for (const nodeTrace of this.nodeTraces.values()) nodeTrace.forget(before);
    this.begin = Math.max(this.begin, before);
  }

  /** Ends all stretches at the end of the run. */
  close(): void {
    for (const uid of [...this.open.keys()]) this.change(uid, 'IDLE', this.now);
    // The results of the last tick are drawn after it, so the drawn run ends with them.
    this.advance(this.resultsEnd);
  }

  status(uid: number): NodeStatus {
    return this.open.get(uid)?.status ?? 'IDLE';
  }

  /** Returns the stretches of a node that overlap a span of time, the current one last. */
  stretches(uid: number, from: number, to: number): Stretch[] {
    const found: Stretch[] = [];
    const nodeTrace = this.nodeTraces.get(uid);
    if (nodeTrace) {
      for (let i = nodeTrace.firstAfter(from); i < nodeTrace.count; i++) {
        const stretch = nodeTrace.at(i);
        if (stretch.start > to) break;
        found.push(stretch);
      }
    }
    const open = this.open.get(uid);
    if (open && open.since <= to) found.push({ start: open.since, end: this.now, mask: BIT[open.status] });
    return found;
  }

  /** Returns for how many seconds a node was running, and how often it started. */
  runningOf(uid: number): { seconds: number; times: number } {
    let seconds = 0;
    let times = 0;
    for (const { start, end, mask } of this.stretches(uid, this.begin, this.now)) {
      if (!(mask & BIT.RUNNING)) continue;
      seconds += end - start;
      times += 1;
    }
    return { seconds, times };
  }

  /** Returns all as text; neighbouring stretches are joined until there are at most so many. */
  keep(stretches = KEPT_STRETCHES): string {
    const uids = new Set([...this.nodeTraces.keys(), ...this.open.keys()]);
    const most = Math.max(8, Math.floor(stretches / Math.max(uids.size, 1)));
    const nodeTraces = [...uids].map((uid): Kept['nodeTraces'][number] => {
      const nodeTrace = new NodeTrace();
      for (const { start, end, mask } of this.stretches(uid, this.begin, this.now))
        nodeTrace.add(start, end, mask);
      nodeTrace.coarsen(most);
      const numbers: number[] = [];
      for (let i = 0; i < nodeTrace.count; i++) {
        const { start, end, mask } = nodeTrace.at(i);
        numbers.push(round(start), round(end), mask);
      }
      return [uid, numbers];
    });
    return JSON.stringify({
      tree: signature(this.nodes),
      begin: this.begin,
      now: this.now,
      nodeTraces,
    } satisfies Kept);
  }

  /** Restores the trace from before a reload, if the same tree still runs; must be called after `start`. */
  restore(text: string | null, t: number): void {
    if (!text) return;
    try {
      const kept = JSON.parse(text) as Kept;
      if (kept.tree !== signature(this.nodes) || kept.now > t + 1 || t - kept.now > this.lengthS) return;
      this.begin = kept.begin;
      for (const [uid, numbers] of kept.nodeTraces) {
        const nodeTrace = this.nodeTrace(uid);
        for (let i = 0; i + 2 < numbers.length; i += 3) {
          nodeTrace.add(numbers[i] ?? 0, numbers[i + 1] ?? 0, numbers[i + 2] ?? 0);
        }
      }
    } catch {
      // An unreadable stored trace is dropped.
    }
  }

  private change(uid: number, status: NodeStatus, t: number): void {
    const before = this.open.get(uid);
    if (before && before.since === t) this.addResult(uid, before.status, t);
    else if (before) this.nodeTrace(uid).add(before.since, t, BIT[before.status]);
    if (status === 'IDLE') this.open.delete(uid);
    else this.open.set(uid, { status, since: t });
  }

  /** Adds a status that a node had only within the tick. */
  private addResult(uid: number, status: NodeStatus, t: number): void {
    this.resultsEnd = t + FLASH_S;
    this.nodeTrace(uid).add(t, this.resultsEnd, BIT[status]);
  }

  private nodeTrace(uid: number): NodeTrace {
    let nodeTrace = this.nodeTraces.get(uid);
    if (!nodeTrace) this.nodeTraces.set(uid, (nodeTrace = new NodeTrace()));
    return nodeTrace;
  }
}

/** Returns a key for each node that lasts over changes: the ids of the SubTree blocks around it, and its own. */
function keysOf(nodes: readonly TreeNode[]): Map<number, string> {
  const keys = new Map<number, string>();
  const scopes = new Map<number, string>();
  for (const { uid, parent, type, node_id } of nodes) {
    const scope = scopes.get(parent) ?? '';
    keys.set(uid, `${scope}/${node_id}`);
    scopes.set(uid, type === 'SubTree' ? `${scope}/${node_id}` : scope);
  }
  return keys;
}

const round = (seconds: number) => Math.round(seconds * 100) / 100;

/** Returns a text that is equal for equal trees. */
function signature(nodes: readonly TreeNode[]): string {
  return nodes.map((node) => `${node.uid}:${node.tree_id}/${node.node_id}:${node.type}`).join(';');
}

export const trace = new Trace();
