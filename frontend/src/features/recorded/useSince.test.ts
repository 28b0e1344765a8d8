import { expect, it } from 'vitest';
import { emptyDiagram, type Diagram } from '@/model/diagram';
import { changedSince } from './useSince';

const ran: Diagram = {
  ...emptyDiagram('Main'),
  root: 'r',
  nodes: {
    r: { type: 'Sequence', children: ['a', 'b', 'c'] },
    a: { type: 'Go', ports: { speed: '1' } },
    b: { type: 'Wait' },
    c: { type: 'Say' },
  },
};
const recorded = { diagram: ran, isAttached: true };

it('marks blocks by their ids of then, also where they have others now', () => {
  const now = {
    ...ran,
    id: 'Main',
    nodes: {
      r: { type: 'Sequence', children: ['x', 'c', 'new'] },
      x: { type: 'Go', ports: { speed: '2' } },
      c: { type: 'Say' },
      new: { type: 'Beep' },
    },
  };
  const since = changedSince(recorded, ['Main'], { Main: now });
  expect([...since.marks]).toEqual([
    ['a', 'changed'],
    ['b', 'removed'],
  ]);
  expect(since.difference.changes.get('new')?.kind).toBe('added');
  expect(since).toMatchObject({ name: 'Main', isRenamed: false });
});

it('knows a renamed tree, and one that is gone', () => {
  expect(changedSince(recorded, ['Main'], { Hall: { ...ran, id: 'Hall' } })).toMatchObject({
    name: 'Hall',
    isRenamed: true,
  });
  const gone = changedSince(recorded, ['Main'], {});
  expect(gone.name).toBeNull();
  expect([...gone.marks.values()]).toEqual(['removed', 'removed', 'removed', 'removed']);
});
