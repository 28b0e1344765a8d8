import { act } from '@testing-library/react';
import { afterEach, expect, it, vi } from 'vitest';
import { fakeServer, openSession } from '../../../harness/testing';
import { refusal } from '../../../harness/requests';
import { useSessionStore } from './store';

afterEach(() => vi.useRealTimers());

it('says that the server was restarted, and continues once its new address was opened', async () => {
  const executor = await openSession();
  const shown = () => {
    const { connection, connectionMessage } = useSessionStore.getState();
    return [connection, connectionMessage];
  };
  executor.emit('waiting', { text: 'Go', node_id: 'n1', node_path: 'Go' });
  executor.emit('going_back', { fraction: 0.5 });
  vi.useFakeTimers();
  fakeServer({ 'GET /sessions/s1': refusal('No.', { code: 'link_required', status: 403 }) });
  act(() => executor['socket']?.onclose?.({ code: 1006, reason: '' }));
  expect(shown()).toEqual(['reconnecting', '']);
  // Nobody knows whether these still last.
  expect(useSessionStore.getState()).toMatchObject({ waiting: { text: '' }, goingBack: null });
  await act(() => vi.advanceTimersByTimeAsync(3000));
  expect(shown()).toEqual([
    'reconnecting',
    'The server was restarted. Open the address that the terminal shows; this page continues by itself.',
  ]);

  fakeServer({ 'GET /sessions/s1': refusal('Gone.', { status: 404 }) });
  await act(() => vi.advanceTimersByTimeAsync(6000));
  expect(shown()).toEqual(['lost', '']);
});
