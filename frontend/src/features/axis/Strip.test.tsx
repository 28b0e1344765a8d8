import { act, fireEvent, screen } from '@testing-library/react';
import { afterEach, beforeEach, expect, it, vi } from 'vitest';
import { segmentOf } from '../../../harness/runs';
import { show } from '../../../harness/testing';
import { atPresent, useMoment } from '@/store/moment/store';
import type { Overview } from '@/store/recording/types';
import { noRange, useRange } from '@/store/moment/range';
import { initialSession } from '@/store/session/reduce';
import { useSessionStore } from '@/store/session/store';
import { Strip } from './Strip';

beforeEach(() => {
  vi.stubGlobal(
    'ResizeObserver',
    class {
      observe() {}
      disconnect() {}
      unobserve() {}
    },
  );
});
afterEach(() => {
  vi.unstubAllGlobals();
  useMoment.setState(atPresent, true);
  useRange.setState(noRange);
  useSessionStore.setState(initialSession, true);
});

const overview: Overview = {
  run: 'a',
  read: [[0, 10]],
  root: [],
  marks: [{ t: 5, kind: 'fault', text: 'ValueError\nmore' }],
  lines: [],
  faults: [],
};

it('has the marks of its own run, and none of another', () => {
  useMoment.setState({ overview });
  const { rerender } = show(<Strip extent={{ run: 'a', from: 0, to: 10 }} />);
  const mark = screen.getByRole('button', { name: 'Fault at 5.00 s: ValueError' });
  expect(mark.style.getPropertyValue('--at')).toBe('50%');
  rerender(<Strip extent={{ run: 'b', from: 0, to: 10 }} />);
  expect(screen.queryByTestId('axis-mark')).toBeNull();
});

it('zooms by the wheel round the pointer, and shows only the marks of that part', () => {
  useSessionStore.setState({
    segments: [segmentOf({ to_t: 10 })],
  });
  useMoment.setState({ overview });
  show(<Strip extent={{ run: 'a', from: 0, to: 10 }} />);
  const strip = screen.getByTestId('axis-strip');
  const box = strip.parentElement!;
  box.getBoundingClientRect = () => ({ left: 0, width: 100 }) as DOMRect;
  for (let turns = 0; turns < 8; turns += 1) fireEvent.wheel(box, { deltaY: -1, clientX: 0 });
  const { view } = useRange.getState();
  expect(view?.from).toBeCloseTo(0);
  expect(view?.to).toBeLessThan(5);
  expect(screen.queryByTestId('axis-mark')).toBeNull();
  fireEvent.wheel(box, { deltaY: 1, shiftKey: true });
  expect(useRange.getState().view?.from).toBeGreaterThan(0);
  act(() => useMoment.setState({ t: 9 }));
  expect(useRange.getState().view?.to).toBeCloseTo(9);
});

it('has the marked range; its ends are buttons', () => {
  useRange.setState({ a: 2, b: 8 });
  show(<Strip extent={{ run: 'a', from: 0, to: 10 }} />);
  expect(screen.getByRole('button', { name: 'Moment A: 2.00 s' }).style.left).toBe('20%');
  expect(screen.getByTestId('axis-end-B').style.left).toBe('80%');
});
