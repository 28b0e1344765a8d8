import { beforeEach, expect, it, onTestFinished, vi } from 'vitest';
import { setPort } from '@/model/edits';
import { useProjectStore } from '@/store/project';
import { openProject } from '../../../harness/testing';
import { followRanTexts } from './ranTexts';
import { useRunStore } from './store';

const project = () => useProjectStore.getState();
const hasChanged = () => {
  vi.advanceTimersByTime(1000);
  return useRunStore.getState().ranAt !== project().changeCounter;
};
const write = (text: string) => project().setFileText('actions/Go.py', text);

beforeEach(() => {
  vi.useFakeTimers();
  openProject({
    trees: { Main: { n1: { type: 'Sleep', ports: { msec: '5' } } } },
    texts: { 'actions/Go.py': 'a = 1' },
  });
  const stop = followRanTexts();
  onTestFinished(() => {
    stop();
    vi.useRealTimers();
    useRunStore.setState(useRunStore.getInitialState(), true);
  });
  useRunStore.setState({ ranAt: project().changeCounter });
});

it('edits that lead back to the texts of the run are no change', () => {
  expect(hasChanged()).toBe(false);
  write('a = 2');
  expect(hasChanged()).toBe(true);
  write('a = 1');
  expect(hasChanged()).toBe(false);
  project().apply('Main', 'port', [setPort('n1', 'msec', '7')]);
  expect(hasChanged()).toBe(true);
  project().undo();
  expect(hasChanged()).toBe(false);
});

it('another file, its removal and another program are changes', () => {
  project().addFile('notes.md', '');
  expect(hasChanged()).toBe(true);
  useRunStore.setState({ ranAt: project().changeCounter });
  write('a = 2');
  useRunStore.setState({ ranAt: project().changeCounter }); // it runs with the edit
  write('a = 1');
  expect(hasChanged()).toBe(true);
});

it('a project that was edited while its program started stays changed', () => {
  const { changeCounter } = project();
  write('a = 2');
  useRunStore.setState({ ranAt: changeCounter - 1 });
  write('a = 1');
  expect(hasChanged()).toBe(true);
});
