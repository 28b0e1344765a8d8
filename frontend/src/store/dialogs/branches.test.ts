import { afterEach, beforeEach, expect, it, vi, type MockInstance } from 'vitest';
import type { Introspection } from '@/generated/messages';
import * as connection from '@/store/session/connection';
import { initialSession } from '@/store/session/reduce';
import { useSessionStore } from '@/store/session/store';
import { segmentOf } from '../../../harness/runs';
import {
  canChangeBranch,
  changeBranch,
  dropBranch,
  nameBranch,
  shownBranch,
  useBranchForm,
} from './branches';
import { ofSession, useSource } from '@/store/moment/source';
import { atPresent, useMoment } from '@/store/moment/store';

let send: MockInstance<typeof connection.send>;
const branch = { run: 'a', parent: 'o', from_t: 2, name: '', is_gone: false };

beforeEach(() => {
  send = vi.spyOn(connection, 'send').mockResolvedValue(undefined);
  useSessionStore.setState({
    ...{ connection: 'open', introspection: { role: 'driver' } as Introspection },
    ...{ segments: [segmentOf({ run: 'a', to_t: 8 })], branches: [branch] },
  });
});

afterEach(() => {
  useSessionStore.setState(initialSession, true);
  useMoment.setState(atPresent, true);
  useSource.setState(ofSession);
  useBranchForm.setState({ run: null });
});

it('opens the form for the shown branch, for the driver alone', () => {
  expect(shownBranch()).toEqual(branch);
  useSessionStore.setState({ introspection: { role: 'viewer' } as Introspection });
  changeBranch();
  expect([canChangeBranch(), useBranchForm.getState().run]).toEqual([false, null]);
  useSessionStore.setState({ introspection: { role: 'driver' } as Introspection });
  changeBranch();
  expect([canChangeBranch(), useBranchForm.getState().run]).toEqual([true, 'a']);
  useSessionStore.setState({ branches: [] });
  expect(canChangeBranch()).toBe(false);
});

it('sends the name, and throws away and shows the present', async () => {
  await nameBranch('a', 'wider');
  useMoment.setState({ t: 3 });
  await dropBranch('a');
  expect(send.mock.calls).toEqual([
    ['name_branch', { run: 'a', name: 'wider' }],
    ['drop_branch', { run: 'a' }],
  ]);
  expect(useMoment.getState().t).toBeNull();
});
