import { renderHook, act } from '@testing-library/react';
import { afterEach, expect, it } from 'vitest';
import { treeNode } from '../../../harness/running';
import { useLiveStore, usePastLive } from '@/store/project/live';
import type { Moment } from '@/store/recording/types';
import { atPresent, useMoment, useShownLive } from './store';

afterEach(() => {
  useMoment.setState(atPresent, true);
  useLiveStore.getState().clear();
  usePastLive.getState().clear();
});

it('shows the statuses of the moment while there is one', () => {
  for (const [store, status] of [
    [useLiveStore, 'RUNNING'],
    [usePastLive, 'FAILURE'],
  ] as const) {
    store.getState().setTree([treeNode(1, 0, 'a')]);
    store.getState().setStatuses([[1, status]]);
  }
  const { result } = renderHook(() => useShownLive(({ statuses }) => statuses.get('Main/n1')));
  expect(result.current).toBe('RUNNING');
  act(() => useMoment.setState({ t: 1, shown: {} as Moment }));
  expect(result.current).toBe('FAILURE');
  act(() => useMoment.setState(atPresent));
  expect(result.current).toBe('RUNNING');
});
