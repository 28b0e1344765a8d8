import { beforeEach, expect, it, onTestFinished } from 'vitest';
import { useBreakpoints } from '@/store/debug/breakpoints';
import { useProjectStore } from '@/store/project';
import {
  changeLine,
  followLines,
  isOfLaunchNode,
  linesOf,
  moveLines,
  removeAllLines,
  renameLines,
  toggleException,
  toggleLine,
  toggleWatch,
  useLines,
} from './lines';

const at = () => useLines.getState().list.map(({ path, line }) => `${path}:${line}`);

beforeEach(() => {
  localStorage.clear();
  useProjectStore.setState({ projectId: 'p1' });
  useLines.setState({ list: [], exceptions: [], watches: [] });
  onTestFinished(() => useProjectStore.setState({ projectId: null }));
});

it('are set in the order of their files and lines, changed, and removed', () => {
  useBreakpoints.setState({ areOn: false });
  toggleLine('b.py', 9);
  toggleLine('b.py', 2);
  toggleLine('a.py', 5);
  expect(useBreakpoints.getState().areOn).toBe(true);
  expect(at()).toEqual(['a.py:5', 'b.py:2', 'b.py:9']);
  changeLine('b.py', 2, { condition: 'x > 1' });
  expect(linesOf(useLines.getState().list, 'b.py').map(({ condition }) => condition)).toEqual(['x > 1', '']);
  toggleLine('b.py', 2);
  expect(at()).toEqual(['a.py:5', 'b.py:9']);
  removeAllLines();
  expect(at()).toEqual([]);
});

it('follow their text and the name of their file; two that meet become one', () => {
  [3, 7, 8].forEach((line) => toggleLine('a.py', line));
  toggleLine('b.py', 3);
  moveLines('a.py', [
    [3, 4],
    [7, 7],
    [8, 7],
  ]);
  expect(at()).toEqual(['a.py:4', 'a.py:7', 'b.py:3']);
  renameLines('a.py', 'c.py');
  expect(at()).toEqual(['c.py:4', 'c.py:7', 'b.py:3']);
});

it('are kept for each user and project, with exceptions and watches', () => {
  let stop = followLines('ann');
  toggleLine('a.py', 3);
  toggleException('raised');
  toggleWatch('self.n');
  useProjectStore.setState({ projectId: 'p2' });
  expect(useLines.getState()).toEqual({ list: [], exceptions: [], watches: [] });
  useProjectStore.setState({ projectId: 'p1' });
  expect(at()).toEqual(['a.py:3']);
  expect(useLines.getState()).toMatchObject({ exceptions: ['raised'], watches: ['self.n'] });
  toggleException('raised');
  toggleWatch('self.n');
  expect(useLines.getState()).toMatchObject({ exceptions: [], watches: [] });
  stop();
  stop = followLines('bob');
  expect(at()).toEqual([]);
  stop();
});

it('leave out what is damaged in a stored text', () => {
  const list = [{ path: 'a.py', line: 3, hits: 'x' }, { path: '', line: 1 }, { path: 'a.py', line: 0 }, 5];
  localStorage.setItem('bts.lines.ann.p1', JSON.stringify({ list, exceptions: ['x'], watches: [1, 'n'] }));
  onTestFinished(followLines('ann'));
  expect(useLines.getState()).toEqual({
    list: [{ path: 'a.py', line: 3, condition: '', hits: 1, log: '', on: true }],
    exceptions: [],
    watches: ['n'],
  });
  localStorage.setItem('bts.lines.ann.p3', '{');
  useProjectStore.setState({ projectId: 'p3' });
  expect(at()).toEqual([]);
});

it('know the files of launch nodes', () => {
  expect(['launch/talker.py', 'actions/launch/a.py'].map(isOfLaunchNode)).toEqual([true, false]);
});
