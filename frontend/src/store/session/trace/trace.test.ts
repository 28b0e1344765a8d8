import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import type { NodeStatus, TreeNode } from '@/generated/messages';
import { Trace, HISTORY_S } from './trace';
import { BIT, NodeTrace, MAX_STRETCHES } from './nodeTrace';

const node = (uid: number): TreeNode => ({
  uid,
  parent: 0,
  type: 'Forward',
  kind: 'Action',
  name: `n${uid}`,
  path: '',
  node_id: `n${uid}`,
  tree_id: 'Main',
});

describe('NodeTrace', () => {
  it('stays in order and bounded, whatever is added', () => {
    const step = fc.record({
      pause: fc.double({ min: 0, max: 1, noNaN: true }),
      mask: fc.constantFrom(1, 2, 4, 8),
    });
    fc.assert(
      fc.property(
        fc.array(step, { minLength: 1, maxLength: 200 }),
        fc.integer({ min: 1, max: 40 }),
        (steps, times) => {
          const nodeTrace = new NodeTrace();
          let t = 0;
          for (let i = 0; i < times; i++) {
            for (const { pause, mask } of steps) {
              nodeTrace.add((t += pause), t + 0.01, mask);
              t += 0.01;
            }
          }
          expect(nodeTrace.count).toBeLessThanOrEqual(MAX_STRETCHES);
          for (let i = 1; i < nodeTrace.count; i++)
            expect(nodeTrace.at(i).start).toBeGreaterThanOrEqual(nodeTrace.at(i - 1).start);
          expect(nodeTrace.at(nodeTrace.count - 1).end).toBeCloseTo(t);
        },
      ),
      { numRuns: 30 },
    );
  });
});

describe('Trace', () => {
  it('keeps what the blocks did that a changed tree still has', () => {
    const trace = new Trace();
    const sub = { ...node(2), type: 'SubTree' };
    trace.start([node(1), sub, { ...node(3), parent: 2, node_id: 'n1' }], 0);
    trace.tick(
      [1, 2, 3].map((uid) => [uid, 'RUNNING']),
      [],
      1,
    );
    const moved = { ...sub, uid: 3 };
    trace.replace([{ ...node(1), node_id: 'new' }, { ...node(2), node_id: 'n1' }, moved], 3);
    trace.tick([[2, 'RUNNING']], [], 4);
    trace.advance(5);
    expect(trace.stretches(1, 0, 10)).toEqual([]);
    expect(trace.stretches(2, 0, 10)).toEqual([
      { start: 1, end: 3, mask: BIT.RUNNING },
      { start: 4, end: 5, mask: BIT.RUNNING },
    ]);
    expect(trace.stretches(3, 0, 10)).toEqual([{ start: 1, end: 3, mask: BIT.RUNNING }]);
    expect([trace.begin, trace.run]).toEqual([0, 1]);
  });

  it('returns the past and present statuses of a node', () => {
    const trace = new Trace();
    trace.start([node(1)], 0);
    trace.tick([[1, 'RUNNING']], [], 1);
    trace.tick([[1, 'SUCCESS']], [], 3);
    trace.advance(4);
    expect(trace.stretches(1, 0, 10)).toEqual([
      { start: 1, end: 3, mask: BIT.RUNNING },
      { start: 3, end: 4, mask: BIT.SUCCESS },
    ]);
    expect(trace.status(1)).toBe('SUCCESS');
    expect(trace.runningOf(1)).toEqual({ seconds: 2, times: 1 });
    trace.close();
    expect(trace.status(1)).toBe('IDLE');
  });

  it('shows results that lasted one tick, joined if they follow each other', () => {
    const trace = new Trace();
    trace.start([node(1)], 0);
    for (let tick = 1; tick <= 20; tick++) trace.tick([], [[1, 'FAILURE']], tick * 0.05);
    const [only, ...others] = trace.stretches(1, 0, 2);
    expect(others).toEqual([]);
    expect(only).toMatchObject({ start: 0.05, mask: BIT.FAILURE });
  });

  it('shows the results of the tick that ended the run', () => {
    const trace = new Trace();
    trace.start([node(1), node(2)], 0);
    trace.tick([[1, 'RUNNING']], [], 1);
    trace.tick([[1, 'FAILURE']], [[2, 'FAILURE']], 2);
    trace.tick([[1, 'IDLE']], [], 2);
    trace.close();
    for (const uid of [1, 2]) {
      const last = trace.stretches(uid, 0, trace.now).at(-1)!;
      expect(last).toMatchObject({ start: 2, mask: BIT.FAILURE });
      expect(last.end).toBeGreaterThan(2);
      expect(last.end).toBeLessThanOrEqual(trace.now);
    }
  });

  it('drops data older than ten minutes', () => {
    const trace = new Trace();
    trace.start([node(1)], 0);
    for (let t = 0; t < HISTORY_S * 2; t++) trace.tick([[1, t % 2 ? 'RUNNING' : 'IDLE']], [], t);
    expect(trace.stretches(1, 0, Infinity)[0]!.start).toBeGreaterThan(HISTORY_S - 30);
  });

  it('is restored after a reload for the same tree only', () => {
    const statuses: NodeStatus[] = ['RUNNING', 'SUCCESS', 'IDLE'];
    const trace = new Trace();
    trace.start([node(1)], 0);
    statuses.forEach((status, index) => trace.tick([[1, status]], [], index + 1));
    const kept = trace.keep();

    const same = new Trace();
    same.start([node(1)], 5);
    same.restore(kept, 5);
    expect(same.stretches(1, 0, 5)).toHaveLength(2);
    expect(same.begin).toBe(0);

    const other = new Trace();
    other.start([node(2)], 5);
    other.restore(kept, 5);
    expect(other.stretches(1, 0, 5)).toEqual([]);
    other.restore('{damaged', 5);
  });

  it('restarts when the world is reset', () => {
    const trace = new Trace();
    trace.start([node(1)], 0);
    trace.tick([[1, 'RUNNING']], [], 60);
    trace.tick([[1, 'RUNNING']], [], 0.05);
    expect(trace.now).toBe(0.05);
    expect(trace.stretches(1, 0, 100)).toHaveLength(1);
  });
});
