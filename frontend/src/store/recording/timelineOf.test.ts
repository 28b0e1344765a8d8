import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { BIT } from '@/store/session/trace/nodeTrace';
import { Trace } from '@/store/session/trace/trace';
import { SegmentIndex } from './segmentIndex';
import type { Step } from './steps';
import { TimelineReader, type RecordedTimeline } from './timelineOf';
import { STATUSES, type StatusOf } from './types';

const node = (uid: number, id = `n${uid}`) => ({
  ...{ uid, parent: uid - 1, type: 'Sequence', kind: 'Control', name: id, path: id },
  ...{ node_id: id, tree_id: 'Main', ports: {} },
});
const tree = (t: number, generation = 1, nodes = [node(1), node(2)]): Step => ({
  ...{ kind: 'tree', t, generation, nodes, files: {} },
});
const tick = (t: number, changed: readonly StatusOf[], flashed: readonly StatusOf[] = []): Step => ({
  ...{ kind: 'tick', t, number: t, durationMs: 1, changed, flashed },
});
const keyframe = (t: number, status: readonly number[]): Step => ({
  ...{ kind: 'keyframe', t, tick: 0, status, entries: [] },
});

function segment(number: number, ...steps: Step[]): SegmentIndex {
  const made = new SegmentIndex(number, steps[0]?.t ?? 0);
  made.steps.push(...steps);
  made.until = steps.at(-1)?.t ?? 0;
  return made;
}

function stretches(timeline: RecordedTimeline | null, uid: number) {
  if (!timeline) return null;
  const trace = new Trace(Infinity);
  trace.start(timeline.nodes, timeline.now);
  trace.restore(timeline.text, timeline.now);
  return trace.stretches(uid, 0, 1e6);
}

describe('TimelineReader', () => {
  it('has no timeline before a tree', () => {
    expect(new TimelineReader().read([])).toBeNull();
    expect(new TimelineReader().read([segment(0, keyframe(0, [1]))])).toBeNull();
  });

  it('shows what a live page would have shown, however the recording is cut and read', () => {
    const status = fc.constantFrom(...STATUSES);
    const changes = fc.uniqueArray(fc.tuple(fc.constantFrom(1, 2), status), {
      selector: ([uid]) => uid,
    });
    fc.assert(
      fc.property(fc.array(changes, { minLength: 1, maxLength: 40 }), fc.nat(40), (ticks, at) => {
        const cut = Math.min(at, ticks.length);
        const live = new Trace(Infinity);
        live.start([node(1), node(2)], 0);
        ticks.forEach((changed, index) => live.tick(changed, [], index + 1));
        const state = new Map<number, number>();
        for (const [uid, name] of ticks.slice(0, cut).flat()) state.set(uid, STATUSES.indexOf(name));
        const steps = ticks.map((changed, index) => tick(index + 1, changed));
        const first = segment(0, tree(0), ...steps.slice(0, cut));
        const again = [tree(cut), keyframe(cut, [state.get(1) ?? 0, state.get(2) ?? 0])];
        const reader = new TimelineReader();
        reader.read([first]);
        const whole = reader.read([first, segment(1, ...again, ...steps.slice(cut))]);
        const shown = { nodes: live.nodes, now: live.now, text: live.keep(1000) };
        for (const uid of [1, 2]) expect(stretches(whole, uid)).toEqual(stretches(shown, uid));
      }),
    );
  });

  it('knows nothing of a part that is missing, until it is read', () => {
    const reader = new TimelineReader();
    const first = segment(0, tree(0), tick(1, [[1, 'RUNNING']]), tick(2, []));
    const last = segment(2, tree(8), keyframe(8, [1, 0]), tick(9, []));
    expect(stretches(reader.read([first, last]), 1)).toEqual([
      { start: 1, end: 2, mask: BIT.RUNNING },
      { start: 8, end: 9, mask: BIT.RUNNING },
    ]);
    const middle = segment(1, tree(3), keyframe(3, [1, 0]), tick(7, []));
    expect(stretches(reader.read([first, middle, last]), 1)).toEqual([
      { start: 1, end: 9, mask: BIT.RUNNING },
    ]);
  });

  it('keeps what blocks did that a changed tree still has', () => {
    const changed = tree(4, 2, [node(1, 'new'), node(2, 'n1')]);
    const one = segment(0, tree(0), tick(1, [[1, 'RUNNING']]), changed, tick(5, [[2, 'FAILURE']]));
    const timeline = new TimelineReader().read([one]);
    expect(timeline!.nodes.map(({ node_id }) => node_id)).toEqual(['new', 'n1']);
    expect(stretches(timeline, 2)![0]).toEqual({ start: 1, end: 4, mask: BIT.RUNNING });
    expect(stretches(timeline, 1)).toEqual([]);
  });
});
