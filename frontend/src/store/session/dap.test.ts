import { expect, it, vi } from 'vitest';
import type { ServerMessage } from '@/generated/messages';
import { feedDap, listenToDap } from './dap';

const message = (command: string): ServerMessage => ({
  id: 'e1',
  command,
  data: { message: { type: 'event', event: 'stopped' } },
  seq: 1,
  t: 0,
});

it('passes on messages of the debugger, to one listener', () => {
  const [first, second] = [vi.fn(), vi.fn()];
  const stopFirst = listenToDap(first);
  const stop = listenToDap(second);
  stopFirst();
  feedDap(message('tick'));
  feedDap(message('dap'));
  expect(first).not.toHaveBeenCalled();
  expect(second.mock.calls).toEqual([[{ type: 'event', event: 'stopped' }]]);
  stop();
  feedDap(message('dap'));
  expect(second).toHaveBeenCalledOnce();
});
