import { screen } from '@testing-library/react';
import { afterEach, beforeEach, expect, it, vi } from 'vitest';
import { show } from '../../../harness/testing';
import { atPresent, useMoment } from '@/store/moment/store';
import type { Overview } from '@/store/recording/types';
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
  expect(mark.style.left).toBe('50%');
  rerender(<Strip extent={{ run: 'b', from: 0, to: 10 }} />);
  expect(screen.queryByTestId('axis-mark')).toBeNull();
});
