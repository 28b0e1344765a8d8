import { describe, expect, it } from 'vitest';
import { emptyDiagram, type Diagram } from '@/model/diagram';
import type { Layout } from '@/model/layout';
import { drawnAt, viewOf } from './entered';

const diagram: Diagram = {
  ...emptyDiagram('Main'),
  root: 'r',
  nodes: {
    r: { type: 'Sequence', children: ['a', 'f'] },
    a: { type: 'Sleep' },
    f: { type: 'Fallback', children: ['b'], collapsed: true },
    b: { type: 'Sequence', children: ['c'] },
    c: { type: 'Sleep' },
  },
};
const layout: Layout = {
  width: 9000,
  height: 300,
  positions: {
    r: { x: 4000, y: 0, width: 200, height: 50 },
    a: { x: 0, y: 100, width: 200, height: 50 },
    f: { x: 8800, y: 100, width: 200, height: 50 },
  },
};
const ROOM = { width: 800, height: 600 };

it('finds the folded block that hides another', () => {
  expect(drawnAt(diagram, layout, 'a')).toBe('a');
  expect(drawnAt(diagram, layout, 'c')).toBe('f');
  expect(drawnAt(diagram, layout, 'gone')).toBeNull();
});

describe('viewOf', () => {
  it('shows a part as a whole where it can be read, at most at its size', () => {
    const { x, y, zoom } = viewOf(diagram, layout, 'a', ROOM)!;
    expect(zoom).toBe(1);
    expect([100 * zoom + x, 125 * zoom + y]).toEqual([400, 300]);
  });

  it('shows the head of a part that is too large, near the edge from which it grows', () => {
    const { x, y, zoom } = viewOf(diagram, layout, 'r', ROOM)!;
    expect(zoom).toBeGreaterThanOrEqual(0.6);
    expect(4100 * zoom + x).toBe(400);
    expect(y).toBeLessThan(100);
    const right = viewOf({ ...diagram, layout: 'horizontal' }, layout, 'r', ROOM)!;
    expect(25 * right.zoom + right.y).toBe(300);
  });

  it('shows the block itself at a wished zoom, and nothing that is not drawn', () => {
    expect(viewOf(diagram, layout, 'r', ROOM, 1)).toEqual({ x: 400 - 4100, y: 275, zoom: 1 });
    expect(viewOf(diagram, layout, 'c', ROOM)).toBeNull();
  });
});
