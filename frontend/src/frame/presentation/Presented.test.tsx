import { render, screen, act } from '@testing-library/react';
import type { TabNode } from 'flexlayout-react';
import { expect, it, onTestFinished } from 'vitest';
import { loadLayout } from '@/workspace/layoutModel';
import { usePresentation } from '@/workspace/presentation';
import { Presented } from './Presented';

it('marks what a presentation shows', () => {
  onTestFinished(() => usePresentation.setState(usePresentation.getInitialState(), true));
  const node = loadLayout('wide', true).getNodeById('video') as TabNode;
  render(<Presented node={node}>picture</Presented>);
  const mark = () => screen.getByText('picture').dataset['presented'];
  expect(mark()).toBeUndefined();
  act(() => usePresentation.setState({ mode: 'robot', view: 'video' }));
  expect(mark()).toBe('robot');
  act(() => usePresentation.setState({ mode: 'tree' }));
  expect(mark()).toBeUndefined();
});
