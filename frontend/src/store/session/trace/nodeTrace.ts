import type { NodeStatus } from '@/generated/messages';

/** The statuses as bits, since several are combined when stretches are joined. */
export const BIT: Record<NodeStatus, number> = { IDLE: 0, RUNNING: 1, SUCCESS: 2, FAILURE: 4, SKIPPED: 8 };

/** Results that follow each other within this time, in s, are drawn as one stretch. */
const JOIN_S = 0.15;
const FIRST_CAPACITY = 16;
export const MAX_STRETCHES = 2048;

export interface Stretch {
  start: number;
  end: number;
  mask: number;
}

/**
 * The statuses of one node over simulated time, oldest first. Its memory is bounded: old stretches are
 * joined.
 */
export class NodeTrace {
  count = 0;
  starts = new Float64Array(FIRST_CAPACITY);
  ends = new Float64Array(FIRST_CAPACITY);
  masks = new Uint8Array(FIRST_CAPACITY);

  add(start: number, end: number, mask: number): void {
    const last = this.count - 1;
    if (last >= 0 && this.masks[last] === mask && start - (this.ends[last] ?? 0) <= JOIN_S) {
      this.ends[last] = Math.max(end, this.ends[last] ?? 0);
      return;
    }
    if (this.count === this.starts.length) this.makeRoom();
    this.starts[this.count] = start;
    this.ends[this.count] = end;
    this.masks[this.count] = mask;
    this.count += 1;
  }

  /** Drops stretches that ended before a time. */
  forget(before: number): void {
    const first = this.firstAfter(before);
    if (first === 0) return;
    for (const column of [this.starts, this.ends, this.masks]) column.copyWithin(0, first, this.count);
    this.count -= first;
  }

  /** Returns the index of the first stretch that ends after a time. */
  firstAfter(time: number): number {
    let low = 0;
    let high = this.count;
    while (low < high) {
      const middle = (low + high) >> 1;
      if ((this.ends[middle] ?? 0) > time) high = middle;
      else low = middle + 1;
    }
    return low;
  }

  at(index: number): Stretch {
    return {
      start: this.starts[index] ?? 0,
      end: this.ends[index] ?? 0,
      mask: this.masks[index] ?? 0,
    };
  }

  /** Joins neighbouring stretches in pairs until at most this many are left. */
  coarsen(most: number): void {
    while (this.count > most) {
      const pairs = this.count >> 1;
      for (let i = 0; i < pairs; i++) {
        this.starts[i] = this.starts[2 * i] ?? 0;
        this.ends[i] = this.ends[2 * i + 1] ?? 0;
        this.masks[i] = (this.masks[2 * i] ?? 0) | (this.masks[2 * i + 1] ?? 0);
      }
      if (this.count % 2 === 1) {
        this.starts[pairs] = this.starts[this.count - 1] ?? 0;
        this.ends[pairs] = this.ends[this.count - 1] ?? 0;
        this.masks[pairs] = this.masks[this.count - 1] ?? 0;
      }
      this.count = pairs + (this.count % 2);
    }
  }

  private makeRoom(): void {
    if (this.count >= MAX_STRETCHES) return this.coarsen(MAX_STRETCHES / 2);
    const grown = this.count * 2;
    const starts = new Float64Array(grown);
    const ends = new Float64Array(grown);
    const masks = new Uint8Array(grown);
    starts.set(this.starts);
    ends.set(this.ends);
    masks.set(this.masks);
    this.starts = starts;
    this.ends = ends;
    this.masks = masks;
  }
}
