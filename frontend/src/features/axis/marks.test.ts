import { afterEach, beforeEach, expect, it } from 'vitest';
import { renderHook } from '@testing-library/react';
import { setEngineLink } from '@/store/moment/looking';
import { atPresent, useMoment } from '@/store/moment/store';
import { initialSession } from '@/store/session/reduce';
import { useSessionStore } from '@/store/session/store';
import { goToMark, markFrom, useMarks } from './marks';

const mark = (t: number) => ({ t, kind: 'flag' as const, text: String(t) });

beforeEach(() => setEngineLink(() => ({ post: () => undefined, onMessage: () => undefined })));
afterEach(() => {
  useSessionStore.setState(initialSession, true);
  useMoment.setState(atPresent, true);
});

it('finds the mark after and before a moment, and never the one that is shown', () => {
  const marks = [1, 2, 3].map(mark);
  expect(markFrom(marks, 2, 1)?.t).toBe(3);
  expect(markFrom(marks, 2, -1)?.t).toBe(1);
  expect(markFrom(marks, 3, 1)).toBeNull();
  expect(markFrom(marks, Infinity, -1)?.t).toBe(3);
});

it('goes from mark to mark, back from the present', () => {
  const segment = {
    branch: 0,
    number: 0,
    version: 0,
    from_t: 0,
    to_t: 10,
    bytes: 1,
    complete: false,
    run_number: 1,
    result: null,
  };
  const flag = (id: string, t: number, run = 'a') => ({ run, id, t, text: id, user: '' });
  useSessionStore.setState({
    segments: [{ ...segment, run: 'a' }],
    flags: [flag('one', 2), flag('two', 4), flag('other', 3, 'b')],
  });
  const { result } = renderHook(() => useMarks('a', 0));
  expect(result.current.map(({ t }) => t)).toEqual([2, 4]);
  goToMark(-1);
  expect(useMoment.getState().t).toBe(4);
  goToMark(-1);
  expect(useMoment.getState().t).toBe(2);
  goToMark(-1);
  expect(useMoment.getState().t).toBe(2);
  goToMark(1);
  expect(useMoment.getState().t).toBe(4);
});
