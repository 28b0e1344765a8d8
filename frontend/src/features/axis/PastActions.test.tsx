import { act, screen } from '@testing-library/react';
import { afterEach, expect, it, onTestFinished } from 'vitest';
import { show, user } from '../../../harness/testing';
import type { Introspection } from '@/generated/messages';
import { registerRunCommands } from '@/features/run/commands';
import { useRunsDialog } from '@/store/dialogs/runs';
import { useTryMany } from '@/store/moment/rerun/tryMany';
import { atPresent, useMoment } from '@/store/moment/store';
import { initialSession } from '@/store/session/reduce';
import { useSessionStore } from '@/store/session/store';
import { segmentOf } from '../../../harness/runs';
import { registerAxisCommands } from './commands';
import { PastActions } from './PastActions';

afterEach(() => {
  useSessionStore.setState(initialSession, true);
  useMoment.setState(atPresent, true);
});

function shown(more: object = {}) {
  onTestFinished(registerAxisCommands());
  onTestFinished(registerRunCommands());
  useSessionStore.setState({
    ...{ connection: 'open', introspection: { role: 'driver' } as Introspection, repeatableRuns: ['a'] },
    ...{ segments: [segmentOf({ run: 'a', to_t: 8 })], ...more },
  });
  useMoment.setState({ t: 2 });
  show(<PastActions />);
}

it('tries values from the shown moment, and keeps the run', async () => {
  shown();
  await user.click(screen.getByRole('button', { name: 'Try many values or seeds from the shown moment' }));
  expect(useTryMany.getState().asking).toMatchObject({ run: 'a', t: 2 });
  await user.click(screen.getByRole('button', { name: 'Keep or download this run…' }));
  expect(useRunsDialog.getState().isOpen).toBe(true);
});

it('keeps its place, hidden, at the present', () => {
  shown();
  act(() => useMoment.setState({ t: null }));
  expect(screen.getByTestId('axis-keep')).not.toBeVisible();
});

it('offers only what is possible: a live run is not tried, one run is not compared', () => {
  shown({ liveRuns: ['a'] });
  expect(screen.queryByTestId('axis-try-many')).toBeNull();
  expect(screen.queryByTestId('axis-compare')).toBeNull();
});
