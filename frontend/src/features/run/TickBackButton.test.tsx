import { act, screen } from '@testing-library/react';
import { afterEach, beforeEach, expect, it, onTestFinished, vi, type MockInstance } from 'vitest';
import type { Introspection } from '@/generated/messages';
import * as connection from '@/store/session/connection';
import { initialSession } from '@/store/session/reduce';
import { useSessionStore } from '@/store/session/store';
import '@/i18n/editorTexts';
import { show, user } from '../../../harness/testing';
import { registerDebugCommands } from '@/features/debug/commands';
import { TickBackButton } from './TickBackButton';

let send: MockInstance<typeof connection.send>;
const button = () => screen.getByRole('button', { name: 'Take world and program one tick back' });

beforeEach(() => {
  send = vi.spyOn(connection, 'send').mockResolvedValue(undefined);
  onTestFinished(registerDebugCommands());
  act(() =>
    useSessionStore.setState({
      executor: 'held',
      introspection: { role: 'driver' } as Introspection,
      repeatableRuns: ['a'],
    }),
  );
});

afterEach(() => act(() => useSessionStore.setState(initialSession, true)));

it('takes a held exact run one tick back, as often as it is pressed', async () => {
  show(<TickBackButton />);
  await user.click(button());
  act(() => useSessionStore.setState({ executor: 'paused' }));
  await user.click(button());
  expect(send.mock.calls).toEqual([
    ['tick_back', {}],
    ['tick_back', {}],
  ]);
});

it('is disabled for a live run, and says why, also by keys', async () => {
  show(<TickBackButton />);
  act(() => useSessionStore.setState({ liveRuns: ['a'] }));
  expect(button()).toHaveAttribute('aria-disabled', 'true');
  await user.tab();
  expect(await screen.findByText(/A live run has no way back by one tick/)).toBeInTheDocument();
  await user.click(button());
  expect(send).not.toHaveBeenCalled();
});
