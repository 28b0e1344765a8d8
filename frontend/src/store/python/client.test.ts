import { expect, it, onTestFinished } from 'vitest';
import { listenToDap } from '@/store/session/dap';
import { FakeDebugger } from '../../../harness/pythonDebugger';
import { openSession } from '../../../harness/testing';
import { dropRequests, request, takeAnswer } from './client';

it('gives each request its answer', async () => {
  const executor = await openSession();
  onTestFinished(listenToDap(takeAnswer));
  const python = new FakeDebugger(executor);
  const threads = request('threads');
  await python.answer('threads', { threads: [] });
  expect(await threads).toEqual({ threads: [] });
  const failed = request('evaluate', { expression: 'x' });
  void failed.catch(() => undefined);
  expect(await python.answer('evaluate', {}, 'NameError: x')).toEqual({ expression: 'x' });
  await expect(failed).rejects.toThrow('NameError: x');
  expect(takeAnswer({ type: 'event' })).toBe(false);
});

it('rejects what the session refuses, and what is lost with the connection', async () => {
  const executor = await openSession();
  const lost = request('threads');
  executor.refuse('dap', 'The session does not pass on this.');
  await expect(request('launch')).rejects.toThrow('The session does not pass on this.');
  dropRequests();
  await expect(lost).rejects.toThrow('disconnected');
});
