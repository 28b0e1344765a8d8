import { act, screen } from '@testing-library/react';
import { beforeEach, describe, expect, it, onTestFinished } from 'vitest';
import { useProjectStore } from '@/store/project';
import { usePresentation } from '@/workspace/presentation';
import { openProject, show, user } from '../../../../harness/testing';
import { useHints } from '../hints';
import { Guide } from './Guide';
import { startGuide, useGuide } from './guide';

const step = () => screen.queryByTestId('guide')?.dataset['step'];
const open = (texts: Record<string, string> = {}) => {
  openProject({ trees: { Main: { r: { type: 'Sequence' }, s: { type: 'Sleep' } } }, texts });
  show(<Guide />);
};

beforeEach(() => {
  localStorage.clear();
  useGuide.setState({ step: null });
  useHints.setState({ done: [] });
  onTestFinished(() => {
    useGuide.setState({ step: null });
    useHints.setState({ done: [] });
    usePresentation.setState(usePresentation.getInitialState(), true);
    localStorage.clear();
  });
});

describe('the first task', () => {
  it('begins by itself on the first project', () => {
    open();
    expect(step()).toBe('block');
    expect(screen.getByRole('region', { name: 'First task' })).toHaveTextContent(/1 of 3.*Drag a block/);
  });

  it('does not begin for who was here before, has skipped it, or has a lesson', () => {
    useHints.setState({ done: ['run'] });
    open();
    expect(step()).toBeUndefined();
    useHints.setState({ done: [] });
    open({ 'lessons/en.md': '# Go' });
    expect(step()).toBeUndefined();
    localStorage.setItem('bts.guide', 'done');
    open();
    expect(step()).toBeUndefined();
  });

  it('is skipped permanently', async () => {
    open();
    await user.click(screen.getAllByRole('button', { name: 'Skip the first task' })[0]!);
    expect(step()).toBeUndefined();
    expect(localStorage.getItem('bts.guide')).toBe('done');
  });

  it('asks for what the selected block needs', () => {
    open();
    act(() => useGuide.setState({ step: 'fill' }));
    act(() => useProjectStore.getState().select('Main', ['r']));
    expect(screen.getByText(/Give it a child/)).toBeInTheDocument();
    act(() => useProjectStore.getState().select('Main', ['s']));
    expect(screen.getByText(/Set one of its ports/)).toBeInTheDocument();
  });

  it('gives way to a presentation, and to nobody who only looks', () => {
    open();
    act(() => usePresentation.setState({ mode: 'tree' }));
    expect(step()).toBeUndefined();
    act(() => usePresentation.setState({ mode: 'off' }));
    expect(step()).toBe('block');
    act(() => useProjectStore.setState({ role: 'viewer' }));
    act(startGuide);
    expect(step()).toBeUndefined();
  });
});
