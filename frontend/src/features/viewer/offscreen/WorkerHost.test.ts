import { describe, expect, it, vi } from 'vitest';
import type { FromWorker } from './messages';
import { WorkerHost } from './WorkerHost';

function host() {
  const post = vi.fn<(message: FromWorker) => void>();
  return { post, host: new WorkerHost(post) };
}

const AT = [1, 2, 0, 0, 0, 0] as const;
const BEFORE = [0, 0, 0, 0, 0, 0] as const;

describe('the host in the worker', () => {
  it('asks the page to move a body, and gives each answer to its question', async () => {
    const { post, host: made } = host();
    const first = made.moveBody('crate', [...AT], [...BEFORE]);
    const second = made.moveBody('ball', [...AT], [...BEFORE]);
    expect(post.mock.calls.map(([message]) => message)).toEqual([
      { kind: 'move', id: 1, body: 'crate', pose: AT, from: BEFORE },
      { kind: 'move', id: 2, body: 'ball', pose: AT, from: BEFORE },
    ]);
    made.moved(2, 'It is too heavy.');
    made.moved(1, null);
    await expect(second).rejects.toThrow('It is too heavy.');
    await expect(first).resolves.toBeUndefined();
  });

  it('reports measured points and cursors', () => {
    const { post, host: made } = host();
    made.addMeasured([1, 2, 3]);
    made.element.style.cursor = 'grab';
    expect(post.mock.calls.map(([message]) => message)).toEqual([
      { kind: 'measured', point: [1, 2, 3] },
      { kind: 'cursor', cursor: 'grab' },
    ]);
  });

  it('lets bodies be dragged when the page says so', () => {
    const { host: made } = host();
    expect(made.canMove()).toBe(false);
    made.mayMove = true;
    expect(made.canMove()).toBe(true);
  });
});
