import { act, screen } from '@testing-library/react';
import { beforeEach, expect, it, onTestFinished } from 'vitest';
import { present, usePresentation } from '@/workspace/presentation';
import { openProject, show, user } from '../../../harness/testing';
import { watchTabs } from '../../../harness/tabs';
import { PresentationBar } from './PresentationBar';

beforeEach(() => {
  openProject({ trees: { Main: { r: { type: 'Sequence' } } } });
  watchTabs();
  onTestFinished(() => usePresentation.setState(usePresentation.getInitialState(), true));
});

it('is there only in a presentation, and ends it', async () => {
  show(<PresentationBar />);
  expect(screen.queryByRole('toolbar')).toBeNull();
  act(() => present('tree'));
  expect(screen.getByRole('toolbar', { name: 'Presentation' })).toBeInTheDocument();
  await user.click(screen.getByRole('button', { name: 'End the presentation (Esc)' }));
  expect(usePresentation.getState().mode).toBe('off');
  expect(screen.queryByRole('toolbar')).toBeNull();
});

it('offers the full screen where the browser has one', () => {
  act(() => present('tree'));
  const { unmount } = show(<PresentationBar />);
  expect(screen.queryByRole('button', { name: 'Full screen' })).toBeNull();
  unmount();
  Object.defineProperty(document, 'fullscreenEnabled', { configurable: true, value: true });
  onTestFinished(() => void Reflect.deleteProperty(document, 'fullscreenEnabled'));
  show(<PresentationBar />);
  expect(screen.getByRole('button', { name: 'Full screen' })).toBeInTheDocument();
});
