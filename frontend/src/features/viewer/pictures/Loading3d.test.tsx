import { act, screen } from '@testing-library/react';
import { expect, it, onTestFinished, vi } from 'vitest';
import { show } from '../../../../harness/testing';
import { Loading3d } from './Loading3d';

it('says that the view loads, but not at once', () => {
  vi.useFakeTimers();
  onTestFinished(() => void vi.useRealTimers());
  show(<Loading3d />);
  act(() => vi.advanceTimersByTime(250));
  expect(screen.getByRole('status')).toBeEmptyDOMElement();
  act(() => vi.advanceTimersByTime(100));
  expect(screen.getByRole('status')).toHaveTextContent('Loading 3D…');
});
