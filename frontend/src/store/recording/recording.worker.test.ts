import { expect, it, vi } from 'vitest';
import * as worker from './recording.worker';

it('answers in the messages of a worker', () => {
  expect(Object.keys(worker)).toEqual([]);
  const post = vi.spyOn(self as unknown as Worker, 'postMessage').mockReturnValue(undefined);
  const ask = { what: 'moment', t: 1, tick: null, known: -1 };
  self.onmessage?.(new MessageEvent('message', { data: { kind: 'ask', id: 7, ask } }));
  expect(post).toHaveBeenCalledWith({ kind: 'answer', id: 7, answer: null });
  self.onmessage = null;
});
