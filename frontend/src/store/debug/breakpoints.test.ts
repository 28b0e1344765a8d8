import { beforeEach, expect, it, onTestFinished } from 'vitest';
import { plainBreakpoint } from '@/model/breakpoints';
import { useProjectStore } from '@/store/project';
import { openDiagram } from '../../../harness/canvas';
import {
  changeBreakpoint,
  followProject,
  removeAllBreakpoints,
  shownBreakpoints,
  switchBreakpoints,
  toggleBreakpoint,
  useBreakpoints,
} from './breakpoints';

let stop: () => void;
const now = () => useBreakpoints.getState();

beforeEach(() => {
  localStorage.clear();
  openDiagram({ root: 'r', nodes: { r: { type: 'Sequence', children: ['a'] }, a: { type: 'Sleep' } } });
  useProjectStore.setState({ projectId: 'p1' });
  stop = followProject('ann');
  onTestFinished(() => stop());
});

it('are kept for each project', () => {
  toggleBreakpoint('Main', 'a');
  switchBreakpoints();
  useProjectStore.setState({ projectId: 'p2' });
  expect(now()).toMatchObject({ list: [], areOn: true });
  useProjectStore.setState({ projectId: 'p1' });
  expect(now()).toMatchObject({ list: [plainBreakpoint('Main', 'a')], areOn: false });
});

it('are on again after one is set', () => {
  switchBreakpoints();
  toggleBreakpoint('Main', 'a');
  expect(now().areOn).toBe(true);
  toggleBreakpoint('Main', 'a');
  expect(now().list).toEqual([]);
});

it('come back with their block', () => {
  toggleBreakpoint('Main', 'a');
  const { diagrams } = useProjectStore.getState();
  const without = { ...diagrams['Main']!, nodes: { r: { type: 'Sequence' } } };
  useProjectStore.setState({ diagrams: { Main: without } });
  expect(shownBreakpoints()).toEqual([]);
  useProjectStore.setState({ diagrams });
  expect(shownBreakpoints()).toEqual([plainBreakpoint('Main', 'a')]);
});

it('are changed, removed, and are those of one user', () => {
  toggleBreakpoint('Main', 'a');
  changeBreakpoint('Main', 'a', { when: 'returns', condition: 'x > 1' });
  expect(now().list).toMatchObject([{ when: 'returns', status: 'FAILURE', condition: 'x > 1' }]);
  stop();
  followProject('bob')();
  expect(now().list).toEqual([]);
  stop = followProject('ann');
  expect(now().list).toHaveLength(1);
  removeAllBreakpoints();
  expect(now().list).toEqual([]);
});

it('begin empty where the stored text is not readable', () => {
  localStorage.setItem('bts.breakpoints.ann.p3', '{');
  useProjectStore.setState({ projectId: 'p3' });
  expect(now().list).toEqual([]);
});
