import { act, renderHook } from '@testing-library/react';
import { afterEach, expect, it } from 'vitest';
import { openProject } from '../../../harness/testing';
import { treeNode } from '../../../harness/running';
import type { Moment } from '@/store/recording/types';
import { initialSession } from '@/store/session/reduce';
import { useShownValues } from '@/store/session/values/shown';
import { usePastSession } from './session';
import { atPresent, useMoment } from './store';
import { useShownValue } from './values';

afterEach(() => {
  useMoment.setState(atPresent, true);
  usePastSession.setState(initialSession, true);
});

it('shows the value of the moment in a block', () => {
  openProject({ trees: { Main: { n1: { type: 'SetBlackboard', ports: { output_key: '{speed}' } } } } });
  act(() => useShownValues.setState({ ports: new Set(['Main/n1/output_key']) }));
  const { result } = renderHook(() => useShownValue('Main/n1/output_key', true));
  expect(result.current).toBeUndefined();
  const row = {
    scope: '',
    key: 'speed',
    type: 'float',
    value: 0.3,
    preview: false,
    removed: false,
    changedAt: 1,
  };
  act(() => {
    usePastSession.setState({ tree: [treeNode(1, 0, 'a')], blackboard: { '\u0000speed': row } });
    useMoment.setState({ t: 1, shown: {} as Moment });
  });
  expect(result.current).toMatchObject({ key: 'speed', value: 0.3, samples: [] });
});
