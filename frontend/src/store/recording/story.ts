import type { TreeNode } from '@/generated/messages';
import { entryId, type SegmentIndex } from './segmentIndex';
import type { Write } from './steps';
import { STATUSES, type Entry, type StatusOf } from './types';

/** A tick with everything that a tree did in it. */
export interface StoryTick {
  readonly number: number;
  readonly t: number;
  readonly changed: readonly StatusOf[];
  /** Results that did not stay, in order. */
  readonly flashed: readonly StatusOf[];
  readonly writes: readonly Write[];
}

/** The ticks of a tree without a gap, up to a moment. */
export interface Story {
  readonly nodes: readonly TreeNode[];
  /** The nodes that were not idle, and the entries, before the first of the ticks. */
  readonly statuses: readonly StatusOf[];
  readonly entries: readonly Entry[];
  readonly ticks: readonly StoryTick[];
  /** Whether the first of the ticks is the first one of the tree. */
  readonly isWhole: boolean;
}

/**
 * Returns the story of a tree up to a moment: from its first tick on, or from the first one after the last gap
 * of the recording. Null if no tree ran then.
 *
 * @param segments those that were read, in order.
 * @param tick the last of several ticks of that time; null: all of them.
 */
export function storyUntil(segments: readonly SegmentIndex[], t: number, tick: number | null): Story | null {
  const teller = new Teller();
  for (const { number, steps } of segments) {
    teller.begin(number);
    for (const step of steps) {
      if (step.t > t) return teller.story();
      if (step.kind === 'tree') teller.tree(step.generation, step.nodes);
      else if (step.kind === 'keyframe') teller.keyframe(step.tick, step.status, step.entries);
      else if (step.kind === 'writes') teller.writes(step.writes);
      else {
        teller.tick({
          number: step.number,
          t: step.t,
          changed: step.changed,
          flashed: step.flashed,
          writes: [],
        });
        if (step.t === t && step.number === tick) return teller.story();
      }
    }
  }
  return teller.story();
}

/** Puts the steps of a recording together; a gap, or another tree, begins a new story. */
class Teller {
  private generation: number | null = null;
  private segment = -1;
  private nodes: readonly TreeNode[] = [];
  private statuses = new Map<number, StatusOf[1]>();
  private entries = new Map<string, Entry>();
  private begun: Pick<Story, 'statuses' | 'entries'> = { statuses: [], entries: [] };
  private ticks: StoryTick[] = [];
  private pending: Write[] = [];
  private last = 0;
  private isWhole = false;

  begin(segment: number): void {
    const follows = segment === this.segment + 1 || this.segment < 0;
    this.segment = segment;
    // A segment that does not follow the last one has a gap before it.
    if (!follows) this.last = -1;
  }

  tree(generation: number, nodes: readonly TreeNode[]): void {
    if (generation === this.generation) return;
    const isFirst = this.generation === null;
    this.generation = generation;
    this.nodes = nodes;
    this.statuses = new Map();
    this.entries = new Map();
    this.restart(!isFirst);
  }

  keyframe(tick: number, status: ArrayLike<number>, entries: readonly Entry[]): void {
    if (tick === this.last && this.ticks.length > 0) return;
    this.statuses = new Map();
    this.nodes.forEach(({ uid }, at) => {
      const name = STATUSES[status[at] ?? 0] ?? 'IDLE';
      if (name !== 'IDLE') this.statuses.set(uid, name);
    });
    this.entries = new Map(entries.map((entry) => [entryId(entry), entry]));
    this.restart(tick === 0 || (this.isWhole && this.ticks.length === 0));
    this.last = tick;
  }

  writes(writes: readonly Write[]): void {
    this.pending.push(...writes);
  }

  tick(tick: StoryTick): void {
    // A halt after the last tick has that tick's number, but is not part of it.
    if (tick.number === this.last && this.ticks.length > 0) return;
    if (this.ticks.length > 0 && tick.number !== this.last + 1) this.restart(false);
    if (this.ticks.length === 0) {
      this.begun = { statuses: [...this.statuses], entries: [...this.entries.values()] };
      this.isWhole ||= tick.number === 1;
    }
    this.ticks.push({ ...tick, writes: this.pending });
    for (const write of this.pending) {
      if (write.isRemoved) this.entries.delete(entryId(write));
      else this.entries.set(entryId(write), write);
    }
    for (const [uid, status] of tick.changed) {
      if (status === 'IDLE') this.statuses.delete(uid);
      else this.statuses.set(uid, status);
    }
    this.pending = [];
    this.last = tick.number;
  }

  story(): Story | null {
    if (this.ticks.length === 0) return null;
    return { nodes: this.nodes, ...this.begun, ticks: this.ticks, isWhole: this.isWhole };
  }

  private restart(isWhole: boolean): void {
    this.ticks = [];
    this.isWhole = isWhole;
    this.pending = [];
  }
}
