import { expect, it } from 'vitest';
import type { Scene } from '@/generated/messages';
import { movedBodies, shortValue } from './changes';

const scene = {
  objects: [
    { id: 1, body: 'robot' },
    { id: 2, body: 'robot' },
    { id: 3, body: 'crate' },
    { id: 4, body: 'door' },
    { id: 5, body: 'door' },
    { id: 6, body: 'door' },
  ],
} as Scene;

it('a body moved as its base did, however far a wheel turned; the farthest body is first', () => {
  const wheelThenBase = [
    { id: 2, metres: 2, degrees: 130 },
    { id: 1, metres: 1, degrees: 5 },
  ];
  const others = [
    { id: 3, metres: 0.1, degrees: 3 },
    { id: 9, metres: 0, degrees: 4 },
  ];
  const expected = [
    { id: 1, name: 'robot', metres: 1, degrees: 5 },
    { id: 3, name: 'crate', metres: 0.1, degrees: 3 },
    { id: 9, name: '#9', metres: 0, degrees: 4 },
  ];
  expect(movedBodies([...others, ...wheelThenBase], scene)).toEqual(expected);
  expect(movedBodies([...wheelThenBase.toReversed(), ...others], scene)).toEqual(expected);
});

it('of a body whose base did not move, the link that moved most counts', () => {
  const poses = [
    { id: 5, metres: 0.2, degrees: 10 },
    { id: 6, metres: 0.4, degrees: 20 },
  ];
  expect(movedBodies(poses, scene)).toEqual([{ id: 6, name: 'door', metres: 0.4, degrees: 20 }]);
});

it('values are short, and one that is missing is a dash', () => {
  expect(shortValue(undefined)).toBe('—');
  expect(shortValue([1, 2])).toBe('[1,2]');
  expect(shortValue({ offset: -0.1646803081181 })).toBe('{"offset":-0.16468}');
  expect(shortValue('x'.repeat(80))).toHaveLength(61);
});
