import { expect, it } from 'vitest';
import { kindsFor } from './actionKinds';

it.each(['IsHome', 'isHome', 'hasBox', 'Can_see', 'check', 'Is', 'CheckDoor'])('%s is a question', (name) => {
  expect(kindsFor(name)).toEqual(['Condition', 'Action', 'Control', 'Decorator']);
});

it.each(['Island', 'Canoe', 'Hasten', 'checkers', 'PickUp', 'ThisIs', ''])('%s is not a question', (name) => {
  expect(kindsFor(name)).toEqual(['Action', 'Condition', 'Control', 'Decorator']);
});

it('offers what can have the children', () => {
  expect(kindsFor('Twice', 1)).toEqual(['Decorator', 'Control']);
  expect(kindsFor('InTurn', 2)).toEqual(['Control']);
});
