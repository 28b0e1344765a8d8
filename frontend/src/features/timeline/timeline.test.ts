import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { rowsOf } from './rows';
import { marks, SHORTEST_S, spanOf, timeLabel, zoomed } from './span';

const node = (uid: number, parent: number, name: string) => ({
  uid,
  parent,
  name,
  type: 'Sequence',
  kind: 'Control',
  path: '',
  node_id: `n${uid}`,
  tree_id: 'Main',
});

describe('span', () => {
  it('follows the run, and stays where it was put', () => {
    expect(spanOf(null, 30, 0, 100)).toEqual({ from: 70, to: 100 });
    expect(spanOf(null, 30, 0, 10)).toEqual({ from: 0, to: 30 });
    expect(spanOf(50, 30, 0, 100)).toEqual({ from: 20, to: 50 });
  });

  it('keeps the time under the pointer where it is while zooming', () => {
    const number = fc.double({ min: 0.1, max: 1, noNaN: true });
    fc.assert(
      fc.property(number, fc.double({ min: 0.2, max: 5, noNaN: true }), (share, factor) => {
        const next = zoomed({ from: 10, to: 40 }, factor, share, 600);
        expect(next.from + (next.to - next.from) * share).toBeCloseTo(10 + 30 * share);
        expect(next.to - next.from).toBeGreaterThanOrEqual(SHORTEST_S);
      }),
    );
  });

  it('marks round times, never too close', () => {
    const found = marks({ from: 3, to: 63 }, 700);
    expect(found[0]).toBe(10);
    expect((found[1] ?? 0) - (found[0] ?? 0)).toBe(10);
    expect(timeLabel(185)).toBe('3:05');
    expect(timeLabel(2.5)).toBe('2.5 s');
  });
});

describe('rows', () => {
  const nodes = [node(1, 0, 'root'), node(2, 1, 'child'), node(3, 2, 'Forward::3')];

  it('are in the order of the tree, indented by depth', () => {
    expect(rowsOf(nodes, '').map(({ name, depth }) => [name, depth])).toEqual([
      ['root', 0],
      ['child', 1],
      ['Forward', 2],
    ]);
  });

  it('are those that a search finds', () => {
    expect(rowsOf(nodes, 'forw').map(({ uid }) => uid)).toEqual([3]);
  });
});
