import { renderHook, waitFor } from '@testing-library/react';
import { expect, it, vi } from 'vitest';
import { attachedTree } from '../../../harness/attached';
import { fakeServer } from '../../../harness/testing';
import type { SessionInfo } from '@/api/types';
import { useProjectStore } from '@/store/project';
import { navigate } from '@/store/route';
import { openBegun } from '@/store/route/begun';
import * as connection from '@/store/session/connection';
import { useSessionStore } from '@/store/session/store';
import { useAttached } from './useAttached';

it('joins the session, and loads each tree of the program', async () => {
  fakeServer({ 'GET /sessions/s1': { id: 's1', state: 'ready', target: 'robot:1667' } });
  const join = vi.spyOn(connection, 'joinSession').mockResolvedValue();
  const { result, unmount } = renderHook(() => useAttached('s1'));
  await waitFor(() => expect(join).toHaveBeenCalled());
  expect(result.current).toMatchObject({ address: 'robot:1667', isShown: false });
  useSessionStore.setState({ attachedTree });
  await waitFor(() => expect(result.current.isShown).toBe(true));
  expect(Object.keys(useProjectStore.getState().diagrams)).toEqual(['Main']);
  useSessionStore.setState({ attachedTree: { ...attachedTree, name: 'Another' } });
  await waitFor(() => expect(useProjectStore.getState().name).toBe('Another'));
  unmount();
  expect(useProjectStore.getState().projectId).toBeNull();
  join.mockRestore();
});

it('joins a session that has just begun without asking for it', async () => {
  const { requests } = fakeServer({});
  const join = vi.spyOn(connection, 'joinSession').mockResolvedValue();
  openBegun({ id: 's1', state: 'starting', target: 'robot:1667' } as SessionInfo);
  const { result, unmount } = renderHook(() => useAttached('s1'));
  await waitFor(() => expect(join).toHaveBeenCalled());
  expect(result.current.address).toBe('robot:1667');
  expect(requests).toEqual([]);
  unmount();
  join.mockRestore();
  navigate('/');
});
