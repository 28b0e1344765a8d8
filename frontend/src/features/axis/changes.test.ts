import { expect, it } from 'vitest';
import type { Scene } from '@/generated/messages';
import { movedBodies, shortValue } from './changes';

it('of a body, the link that moved most is named, the farthest body first', () => {
  const scene = {
    objects: [
      { id: 1, body: 'robot' },
      { id: 2, body: 'robot' },
      { id: 3, body: 'crate' },
    ],
  } as Scene;
  const poses = [
    { id: 3, metres: 0.1, degrees: 3 },
    { id: 1, metres: 1, degrees: 0 },
    { id: 2, metres: 2, degrees: 90 },
    { id: 9, metres: 0, degrees: 4 },
  ];
  expect(movedBodies(poses, scene)).toEqual([
    { id: 2, name: 'robot', metres: 2, degrees: 90 },
    { id: 3, name: 'crate', metres: 0.1, degrees: 3 },
    { id: 9, name: '#9', metres: 0, degrees: 4 },
  ]);
});

it('values are short, and one that is missing is a dash', () => {
  expect(shortValue(undefined)).toBe('—');
  expect(shortValue([1, 2])).toBe('[1,2]');
  expect(shortValue('x'.repeat(80))).toHaveLength(61);
});
