import { expect, it } from 'vitest';
import type { NodeStatus } from '@/generated/messages';
import { readFacts } from './facts';
import { byCondition, deciding, type Parent } from './verdict';

const parent = (before: NodeStatus, result: NodeStatus, conditions: readonly string[] | null): Parent => {
  const nodes = [
    { uid: 1, parent: 0, type: 'Sequence', kind: 'Control' },
    { uid: 2, parent: 1, type: 'Act', kind: 'Action' },
  ];
  const facts = {
    nodes,
    before: new Map([[1, before]]),
    changed: [],
    flashed: [],
    conditions: () => conditions,
  };
  const node = readFacts(facts).get(1);
  if (!node) throw new Error('no node');
  return { node, result };
};

it('a result tells which pre-conditions can have decided', () => {
  const all = ['_failureIf', '_successIf', '_skipIf', '_while'];
  expect(deciding(parent('IDLE', 'FAILURE', all))).toEqual(['_failureIf']);
  expect(deciding(parent('IDLE', 'SKIPPED', all))).toEqual(['_skipIf', '_while']);
  expect(deciding(parent('RUNNING', 'SKIPPED', all))).toEqual(['_while']);
  expect(deciding(parent('IDLE', 'SKIPPED', ['_while']))).toEqual(['_while']);
  expect(deciding(parent('IDLE', 'SUCCESS', ['_while']))).toEqual([]);
});

it('a node that a condition decided ticks no child; unknown conditions are not named', () => {
  expect(byCondition(parent('IDLE', 'SKIPPED', ['_skipIf']))).toEqual([
    {
      ticked: 'no',
      result: null,
      reason: { code: 'condition', status: 'SKIPPED', conditions: ['_skipIf'] },
    },
  ]);
  expect(byCondition(parent('IDLE', 'FAILURE', null))[0]?.reason.conditions).toEqual([]);
});
