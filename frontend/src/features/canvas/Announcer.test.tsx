import { act, screen } from '@testing-library/react';
import { beforeEach, expect, it, onTestFinished } from 'vitest';
import { useLiveStore } from '@/store/project/live';
import type { ShownProblem } from '@/store/project/problems';
import { useProjectStore } from '@/store/project';
import { useLiveValues } from '@/store/session/values/live';
import { useShownValues } from '@/store/session/values/shown';
import { openDiagram } from '../../../harness/canvas';
import { show } from '../../../harness/testing';
import { Announcer } from './Announcer';

const problem: ShownProblem = {
  source: 'server',
  severity: 'error',
  node: 'b',
  code: '',
  message: 'It is wrong.',
  hint: '',
};
const text = () => document.getElementById('canvas-announcer')?.textContent;
const select = (tree: string, ...ids: string[]) => act(() => useProjectStore.getState().select(tree, ids));

beforeEach(() => {
  openDiagram({
    root: 'r',
    nodes: {
      r: { type: 'Sequence', name: 'Work', children: ['a', 'b'] },
      a: { type: 'Sleep', disabled: true },
      b: { type: 'Sleep', name: 'Nap' },
    },
  });
  show(<Announcer treeId="Main" problems={new Map([['b', problem]])} />);
});

it('announces the name, the type and the place of the selected block', () => {
  expect(text()).toBe('');
  select('Main', 'r');
  expect(text()).toBe('Work, Sequence, top of the tree');
  select('Main', 'b', 'a');
  expect(text()).toContain('Nap, Sleep, child 2 of 2 of Work');
});

it('announces its problem, and that it is disabled', () => {
  select('Main', 'b');
  expect(text()).toBe(
    'Nap, Sleep, child 2 of 2 of Work, It is wrong. Press Control and full stop to see the fixes.',
  );
  select('Main', 'a');
  expect(text()).toBe('Sleep, Sleep, child 1 of 2 of Work, disabled');
});

it('announces its status in the run', () => {
  select('Main', 'r');
  act(() => useLiveStore.setState({ statuses: new Map([['Main/r', 'RUNNING']]) }));
  expect(text()).toBe('Work, Sequence, top of the tree, running');
  act(() =>
    useLiveStore.setState({
      statuses: new Map([['Main/r', 'FAILURE']]),
      faults: new Map([['Main/r', 'boom.']]),
    }),
  );
  expect(text()).toBe(
    'Work, Sequence, top of the tree, failure, It failed in the last run: boom. Press Control and full stop to see it.',
  );
});

it('is silent while no block of this tree is selected', () => {
  select('Main', 'gone');
  expect(text()).toBe('');
  select('Other', 'r');
  expect(text()).toBe('');
  expect(screen.getByText('', { selector: '#canvas-announcer' })).toHaveAttribute('aria-live', 'polite');
});

it('tells the values that the block shows, and does not follow them', () => {
  useShownValues.setState({ ports: new Set(['Main/a/msec']) });
  const live = { key: 'wait', value: 12.34567, changedAt: 1, samples: [] };
  useLiveValues.setState({ values: new Map([['Main/a/msec', live]]) });
  onTestFinished(() => {
    useShownValues.setState({ ports: new Set() });
    useLiveValues.setState({ values: new Map() });
  });
  select('Main', 'a');
  expect(text()).toContain('msec is 12.35');
  act(() => useLiveValues.setState({ values: new Map([['Main/a/msec', { ...live, value: 13 }]]) }));
  expect(text()).toContain('msec is 12.35');
});
