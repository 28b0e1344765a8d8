import { act, renderHook, screen } from '@testing-library/react';
import { beforeEach, expect, it, onTestFinished } from 'vitest';
import { setPort } from '@/model/edits';
import { useProjectStore } from '@/store/project';
import { initialSession } from '@/store/session/reduce';
import { useSessionStore } from '@/store/session/store';
import { openProject, show } from '../../../../harness/testing';
import { useGuide, type Step } from './guide';
import { useProgress } from './useProgress';

const step = () => useGuide.getState().step;
const begin = (at: Step) => {
  useGuide.setState({ step: at });
  renderHook(() => useProgress());
};
const setWait = () =>
  act(() => useProjectStore.getState().apply('Main', 'port', [setPort('s', 'msec', '5')]));

beforeEach(() => {
  openProject({ trees: { Main: { s: { type: 'Sleep' } } }, selected: ['s'] });
  onTestFinished(() => {
    useSessionStore.setState(initialSession);
    useGuide.setState({ step: null });
    document.body.innerHTML = '';
    localStorage.clear();
  });
});

it('continues with a port that was set', () => {
  begin('fill');
  setWait();
  expect(step()).toBe('run');
});

it('waits until the value is confirmed or left', () => {
  begin('fill');
  const field = document.body.appendChild(document.createElement('input'));
  field.focus();
  setWait();
  expect(step()).toBe('fill');
  act(() => void field.dispatchEvent(new KeyboardEvent('keydown', { key: '5', bubbles: true })));
  expect(step()).toBe('fill');
  act(() => field.blur());
  expect(step()).toBe('run');
});

it('does not continue with what belongs to another step', () => {
  begin('block');
  setWait();
  expect(step()).toBe('block');
});

it('ends with a run that begins, and says so', async () => {
  show(<div />);
  useSessionStore.setState({ executor: 'application_running' });
  begin('run');
  act(() => useSessionStore.setState({ tick: 3 }));
  expect(step()).toBe('run');
  act(() => useSessionStore.setState({ executor: 'paused' }));
  act(() => useSessionStore.setState({ executor: 'application_running' }));
  expect(step()).toBeNull();
  expect(await screen.findByText('Your first tree runs')).toBeInTheDocument();
});
