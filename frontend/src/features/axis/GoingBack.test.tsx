import { act, screen } from '@testing-library/react';
import { afterEach, beforeEach, expect, it, vi, type MockInstance } from 'vitest';
import { show, user } from '../../../harness/testing';
import type { Introspection } from '@/generated/messages';
import { atPresent, useMoment } from '@/store/moment/store';
import * as connection from '@/store/session/connection';
import { initialSession } from '@/store/session/reduce';
import { useSessionStore } from '@/store/session/store';
import { segmentOf } from '../../../harness/runs';
import { registerAxisCommands } from './commands';
import { GoBackButton, GoingBack, RunOnButton } from './GoingBack';

let send: MockInstance<typeof connection.send>;
const driver = { role: 'driver' } as Introspection;

beforeEach(() => {
  send = vi.spyOn(connection, 'send').mockResolvedValue(undefined);
});

afterEach(() => {
  useSessionStore.setState(initialSession, true);
  useMoment.setState(atPresent, true);
});

it('offers the way back only where it is possible', async () => {
  const unregister = registerAxisCommands();
  useSessionStore.setState({
    connection: 'open',
    introspection: driver,
    segments: [segmentOf({ run: 'a', to_t: 8 })],
  });
  useMoment.setState({ t: 2 });
  show(<GoBackButton />);
  expect(screen.queryByRole('button')).toBeNull();
  act(() => useSessionStore.setState({ repeatableRuns: ['a'] }));
  await user.click(screen.getByRole('button', { name: 'Go back to here' }));
  expect(send).toHaveBeenCalledWith('go_back', { run: 'a', t: 2 });
  // The present is shown; the axis stays as wide.
  expect(screen.getByTestId('axis-go-back')).not.toBeVisible();
  unregister();
});

it('says of a live run that its program begins again', async () => {
  const unregister = registerAxisCommands();
  useSessionStore.setState({
    ...{ connection: 'open', introspection: driver, repeatableRuns: ['a'], liveRuns: ['a'] },
    segments: [segmentOf({ run: 'a', to_t: 8 })],
  });
  useMoment.setState({ t: 2 });
  show(<GoBackButton />);
  await user.hover(screen.getByRole('button', { name: 'Go back to here' }));
  expect(await screen.findByText(/begins again there/)).toBeVisible();
  unregister();
});

it('says where the program was changed by hand that there is no way back', async () => {
  const unregister = registerAxisCommands();
  useSessionStore.setState({
    ...{ connection: 'open', introspection: driver, repeatableRuns: ['a'], runsByHand: { a: 1.5 } },
    segments: [segmentOf({ run: 'a', to_t: 8 })],
  });
  useMoment.setState({ t: 2 });
  show(<GoBackButton />);
  const button = screen.getByRole('button', { name: 'Go back to here' });
  expect(button).toHaveAttribute('aria-disabled', 'true');
  await user.click(button);
  expect(send).not.toHaveBeenCalled();
  await user.hover(button);
  expect(await screen.findByText(/changed by hand .* at 1.50 s/)).toBeVisible();
  act(() => useMoment.setState({ t: 1.25 }));
  expect(button).toHaveAttribute('aria-disabled', 'false');
  unregister();
});

it('offers to run on where the run is paused, for the driver', () => {
  const unregister = registerAxisCommands();
  useSessionStore.setState({ connection: 'open', introspection: driver });
  show(<RunOnButton />);
  expect(screen.queryByRole('button')).toBeNull();
  act(() => useSessionStore.setState({ executor: 'paused' }));
  expect(screen.getByRole('button', { name: 'Run on' })).toBeVisible();
  act(() => useSessionStore.setState({ introspection: { role: 'viewer' } as Introspection }));
  expect(screen.queryByRole('button')).toBeNull();
  unregister();
});

it('shows how far the run is on its way, and ends it for the driver', async () => {
  useSessionStore.setState({ introspection: driver });
  show(<GoingBack />);
  expect(screen.queryByRole('status')).toBeNull();
  act(() => useSessionStore.setState({ goingBack: 0.45 }));
  expect(screen.getByRole('status').textContent).toContain('made again');
  expect(screen.getByRole('progressbar').getAttribute('aria-valuenow')).toBe('45');
  await user.click(screen.getByRole('button', { name: 'Cancel' }));
  expect(send).toHaveBeenCalledWith('cancel', {});
  act(() => useSessionStore.setState({ introspection: { role: 'viewer' } as Introspection }));
  expect(screen.queryByRole('button')).toBeNull();
});
