import { act, renderHook } from '@testing-library/react';
import { afterEach, describe, expect, it } from 'vitest';
import type { Segment } from '@/generated/messages';
import { initialSession } from '@/store/session/reduce';
import { useSessionStore } from '@/store/session/store';
import { ofSession, useSource } from './source';
import { useExtent } from './useExtent';

const segment = (more: Partial<Segment>): Segment => ({
  run: 'r1',
  branch: 0,
  number: 0,
  version: 0,
  from_t: 0,
  to_t: 20,
  bytes: 100,
  complete: true,
  run_number: 1,
  result: null,
  ...more,
});

afterEach(() =>
  act(() => {
    useSessionStore.setState(initialSession, true);
    useSource.setState(ofSession);
  }),
);

describe('useExtent', () => {
  it('is null without a recording, and follows the segments of the session', () => {
    const { result } = renderHook(useExtent);
    expect(result.current).toBeNull();
    act(() =>
      useSessionStore.setState({ segments: [segment({}), segment({ number: 1, from_t: 20, to_t: 31 })] }),
    );
    expect(result.current).toEqual({ run: 'r1', from: 0, to: 31 });
  });

  it('is that of a kept run while one is open', () => {
    const { result } = renderHook(useExtent);
    const source = {
      segments: () => [segment({ run: 'k', from_t: 3, to_t: 9 })],
      subscribe: () => () => undefined,
      read: () => Promise.reject(new Error('not read')),
    };
    act(() => useSource.setState({ source, kept: { id: 'k', name: 'Kept' } }));
    expect(result.current).toEqual({ run: 'k', from: 3, to: 9 });
  });
});
