import { describe, expect, it } from 'vitest';
import type { NodeStatus } from '@/generated/messages';
import { DECORATOR_RULES } from './decorators';
import { readFacts } from './facts';

type Pair = readonly [number, NodeStatus];

function code(
  type: string,
  result: NodeStatus,
  flashed: readonly Pair[] = [],
  { before = [] as readonly Pair[], conditions = [] as readonly string[] | null } = {},
): string {
  const nodes = [
    { uid: 1, parent: 0, type, kind: 'Decorator' },
    { uid: 2, parent: 1, type: 'Act', kind: 'Action' },
  ];
  const changed: Pair[] = [[1, result === 'SKIPPED' ? 'IDLE' : result]];
  const facts = { nodes, before: new Map(before), changed, flashed, conditions: () => conditions };
  const node = readFacts(facts).get(1);
  const verdict = node && DECORATOR_RULES[type]?.({ node, result })[0];
  return verdict ? `${verdict.ticked} ${verdict.reason.code}` : '';
}

describe('the reasons of decorators', () => {
  it('each says why its child is ticked', () => {
    const flashed: Pair[] = [[2, 'SUCCESS']];
    expect(code('Inverter', 'FAILURE', flashed)).toBe('yes child');
    expect(code('Delay', 'SUCCESS', flashed)).toBe('yes delayOver');
    expect(code('Precondition', 'SUCCESS', flashed)).toBe('yes admitted');
    expect(code('LoopInt', 'RUNNING', flashed)).toBe('yes element');
    expect(code('SubTree', 'RUNNING', [], { before: [[2, 'RUNNING']] })).toBe('yes childAgain');
  });

  it('and why it is not', () => {
    expect(code('Delay', 'RUNNING')).toBe('no delay');
    expect(code('Timeout', 'FAILURE')).toBe('no expired');
    expect(code('Precondition', 'SKIPPED')).toBe('no refused');
    expect(code('RunOnce', 'SKIPPED')).toBe('no ranOnce');
    expect(code('WaitValueUpdate', 'RUNNING')).toBe('no notUpdated');
    expect(code('Repeat', 'SUCCESS')).toBe('no noCycle');
    expect(code('LoopDouble', 'SUCCESS')).toBe('no noElement');
    expect(code('Inverter', 'SKIPPED')).toBe('no condition');
  });

  it('a reason that a pre-condition can have given as well was not recorded', () => {
    expect(code('RunOnce', 'SKIPPED', [], { conditions: ['_skipIf'] })).toBe('no notRecorded');
    expect(code('RunOnce', 'SKIPPED', [], { conditions: null })).toBe('no notRecorded');
    expect(code('RunOnce', 'SKIPPED', [], { conditions: ['_successIf'] })).toBe('no ranOnce');
  });
});
