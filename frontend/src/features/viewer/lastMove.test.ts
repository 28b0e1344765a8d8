import { beforeEach, describe, expect, it, onTestFinished } from 'vitest';
import type { Introspection } from '@/generated/messages';
import { atPresent, useMoment } from '@/store/moment/store';
import { openSession } from '../../../harness/testing';
import { canMove, moveBack, useMoves } from './lastMove';

const FROM: [number, number, number, number, number, number] = [1, 2, 0, 0, 0, 0.5];

beforeEach(() => useMoves.setState({ last: null }));

describe('canMove', () => {
  it.each([
    ['universe_ready', true],
    ['visualization_ready', true],
    ['paused', true],
    ['application_running', false],
    ['connected', false],
  ] as const)('in the state %s: %s', async (state, can) => {
    const executor = await openSession({ state });
    expect(canMove()).toBe(can);
    executor.introduce({ state, role: 'viewer' } satisfies Partial<Introspection>);
    expect(canMove()).toBe(false);
  });

  it('is false while one looks back', async () => {
    onTestFinished(() => useMoment.setState(atPresent));
    await openSession({ state: 'paused' });
    useMoment.setState({ t: 1 });
    expect(canMove()).toBe(false);
  });
});

describe('moveBack', () => {
  it('puts the last body back, once', async () => {
    const executor = await openSession({ state: 'paused' });
    await moveBack();
    expect(executor.sentAs('move_body')).toEqual([]);
    useMoves.setState({ last: { body: 'crate', from: FROM } });
    await moveBack();
    expect(executor.sentAs('move_body')).toEqual([{ id: 'crate', pose: FROM }]);
    expect(useMoves.getState().last).toBeNull();
  });

  it('can be repeated after a refusal', async () => {
    const executor = await openSession({ state: 'paused' });
    executor.refuse('move_body', 'Something stands there.');
    useMoves.setState({ last: { body: 'crate', from: FROM } });
    await expect(moveBack()).rejects.toThrow('Something stands there.');
    expect(useMoves.getState().last).not.toBeNull();
  });
});
