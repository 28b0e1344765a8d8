import { expect, it } from 'vitest';
import { parse } from 'yaml';
import type { Diagram } from '@/model/diagram';
import { firstTest } from './firstTest';

const diagram = {
  root: 'r',
  nodes: {
    r: { type: 'Sequence', children: ['a', 'b', 'c'] },
    a: { type: 'Turn' },
    b: { type: 'Turn' },
    c: { type: 'Sleep' },
  },
} as unknown as Diagram;

it('doubles each action of the tree once', () => {
  const written = parse(firstTest('Main: "x"', diagram, new Set(['Turn', 'Other']))) as { tests: unknown[] };
  expect(written.tests).toEqual([
    {
      name: 'the first tick',
      tree: 'Main: "x"',
      doubles: { Turn: 'SUCCESS' },
      ticks: 1,
      expect: [{ at: 1, root: 'SUCCESS' }],
    },
  ]);
});

it('leaves the doubles out where there is no action', () => {
  expect(firstTest('Main', undefined, new Set())).not.toContain('doubles');
});
