import type { NodeStatus, TreeNode } from '@/generated/messages';
import { Trace } from '@/store/session/trace/trace';
import type { SegmentIndex } from './segmentIndex';
import type { KeyframeStep } from './steps';
import { STATUSES } from './types';

/** What the stretches of all nodes are joined to at most, so that the page gets some megabytes. */
const MOST_STRETCHES = 200_000;

/** The statuses of all nodes of a recorded run over time. */
export interface RecordedTimeline {
  /** The nodes of the last tree of the run. */
  readonly nodes: readonly TreeNode[];
  /** The last time that was read, in s. */
  readonly now: number;
  /** For `Trace.restore`. */
  readonly text: string;
}

/** Follows the statuses of a recording while it is read; what was taken once is not taken again. */
export class TimelineReader {
  private trace = new Trace(Infinity);
  private generation: number | null = null;
  /** How many steps of each segment were taken, in the order of the recording. */
  private taken: { readonly segment: SegmentIndex; steps: number }[] = [];

  /** Returns the timeline of the segments that were read, which are in order; null if no tree ran. */
  read(segments: readonly SegmentIndex[]): RecordedTimeline | null {
    if (!this.goesOn(segments)) this.forget();
    for (const [at, segment] of segments.entries()) this.take(segment, at, segments[at - 1]);
    const { nodes, now } = this.trace;
    return nodes.length > 0 ? { nodes, now, text: this.trace.keep(MOST_STRETCHES) } : null;
  }

  /** Returns whether the segments have at most more at their end than those that were taken. */
  private goesOn(segments: readonly SegmentIndex[]): boolean {
    return this.taken.every(
      ({ segment, steps }, at) =>
        segments[at] === segment &&
        (at === this.taken.length - 1 || segment.steps.length === steps) &&
        (at === 0 || segments[at - 1]?.number === segment.number - 1),
    );
  }

  private forget(): void {
    this.trace = new Trace(Infinity);
    this.generation = null;
    this.taken = [];
  }

  private take(segment: SegmentIndex, at: number, before: SegmentIndex | undefined): void {
    // What the nodes did between two segments that do not follow each other is not known.
    if (before && before.number + 1 !== segment.number) this.trace.close();
    const taken = (this.taken[at] ??= { segment, steps: 0 });
    for (const step of segment.steps.slice(taken.steps)) {
      if (step.kind === 'tree') this.takeTree(step.generation, step.nodes, step.t);
      else if (step.kind === 'keyframe') this.trace.tick(this.changedBy(step), [], step.t);
      else if (step.kind === 'tick') this.trace.tick(step.changed, step.flashed, step.t);
    }
    taken.steps = segment.steps.length;
    this.trace.advance(segment.until);
  }

  private takeTree(generation: number, nodes: readonly TreeNode[], t: number): void {
    if (generation === this.generation) return;
    if (this.generation === null) this.trace.start(nodes, t);
    else this.trace.replace(nodes, t);
    this.generation = generation;
  }

  private changedBy({ status }: KeyframeStep): [number, NodeStatus][] {
    return this.trace.nodes.flatMap(({ uid }, at) => {
      const name = STATUSES[status[at] ?? 0] ?? 'IDLE';
      return name === this.trace.status(uid) ? [] : [[uid, name] as [number, NodeStatus]];
    });
  }
}
