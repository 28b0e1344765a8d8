import { act, cleanup } from '@testing-library/react';
import { beforeEach, describe, expect, it, onTestFinished, vi } from 'vitest';
import type { Diagnostic } from '@/api/types';
import type { Fault } from '@/generated/messages';
import { useProjectStore } from '@/store/project';
import { useRunStore } from '@/store/run/store';
import { initialSession } from '@/store/session/reduce';
import { useSessionStore } from '@/store/session/store';
import { openProject, show, watchNavigation } from '../../../harness/testing';
import { useRunReactions } from './useRunReactions';

const showPanel = vi.fn();
const openFile = vi.fn();

function Page() {
  useRunReactions({ showPanel, openFile });
  return null;
}

beforeEach(() => {
  showPanel.mockClear();
  openFile.mockClear();
  openProject({ texts: { 'actions/Go.py': '' } });
  show(<Page />);
  onTestFinished(() => {
    useSessionStore.setState(initialSession, true);
    useRunStore.setState(useRunStore.getInitialState(), true);
  });
});

it('forgets the failure, and the edit that ran, when the project is closed', () => {
  act(() =>
    useRunStore.setState({
      failure: { stage: 'checking', code: 'x', message: '', hint: '', diagnostics: [] },
      ranAt: 12,
      declinedRestart: 12,
    }),
  );
  cleanup();
  expect(useRunStore.getState()).toMatchObject({ failure: null, ranAt: 0, declinedRestart: null });
});

describe('a run that was refused', () => {
  const fail = (diagnostics: Diagnostic[]) =>
    act(() =>
      useRunStore.setState({ failure: { stage: 'checking', code: 'x', message: '', hint: '', diagnostics } }),
    );

  it('shows the problems', () => {
    const diagnostics: Diagnostic[] = [{ code: 'X1', severity: 'error', message: 'bad' }];
    fail(diagnostics);
    expect(showPanel).toHaveBeenCalledExactlyOnceWith('problems');
    expect(useProjectStore.getState().diagnostics).toEqual(diagnostics);
  });

  const missing = { code: 'BT0201', severity: 'error', message: 'bad', tree: 'Main', node: 'a' } as const;
  const inTree = () =>
    openProject({ trees: { Main: { r: { type: 'Sequence', children: ['a'] }, a: { type: 'Sleep' } } } });

  it('leads to the block, and into the field of the port', () => {
    inTree();
    const { openTree, focusField } = watchNavigation();
    fail([{ ...missing, port: 'msec', file: 'trees/Main.json', line: 1 }]);
    expect(openTree).toHaveBeenCalledExactlyOnceWith('Main');
    expect(useProjectStore.getState()).toMatchObject({
      selection: ['a'],
      revealed: { tree: 'Main', node: 'a' },
    });
    expect(focusField).toHaveBeenCalledExactlyOnceWith('msec');
    expect(openFile).not.toHaveBeenCalled();
  });

  it.each<[string, Diagnostic[], number]>([
    ['a tree without a block', [{ ...missing, node: '' }], 1],
    ['a block that is gone', [{ ...missing, node: 'gone' }], 1],
    ['a tree that is gone', [{ ...missing, tree: 'Gone' }], 0],
    ['a file', [{ code: 'BT0601', severity: 'error', message: 'bad', file: 'actions/Go.py' }, missing], 0],
    ['a warning', [{ ...missing, severity: 'warning' }], 0],
  ])('shows the tree at most, and leaves the selection: %s', (_what, diagnostics, opened) => {
    inTree();
    const { openTree, focusField } = watchNavigation();
    fail(diagnostics);
    expect(openTree).toHaveBeenCalledTimes(opened);
    expect(useProjectStore.getState().selection).toEqual([]);
    expect(focusField).not.toHaveBeenCalled();
  });

  it('shows no list if there are no problems', () => {
    fail([]);
    expect(showPanel).not.toHaveBeenCalled();
  });
});

describe('a fault', () => {
  const fault = (more: Partial<Fault>) =>
    act(() =>
      useSessionStore.setState({
        faults: [
          {
            kind: 'exception',
            message: '',
            hint: '',
            node_id: '',
            tree_id: '',
            node_path: '',
            file: 'actions/Go.py',
            line: 3,
            traceback: '',
            ...more,
          },
        ],
      }),
    );

  it('opens its line', () => {
    fault({});
    expect(openFile).toHaveBeenCalledExactlyOnceWith('actions/Go.py', 3);
  });

  it.each([{ kind: 'process' as const }, { line: 0 }, { file: '' }, { file: 'lib/other.py' }])(
    'opens nothing with %j',
    (more) => {
      fault(more);
      expect(openFile).not.toHaveBeenCalled();
    },
  );
});

describe('the messages about a run', () => {
  const fault = (kind: Fault['kind'], file: string): Fault => ({
    ...{
      kind,
      file,
      line: 3,
      message: kind,
      hint: '',
      node_id: '',
      tree_id: '',
      node_path: '',
      traceback: '',
    },
  });

  it('are removed with the first edit, except for those of launch nodes', () => {
    const node = { id: 'x', name: 'x', package: '', executable: '', file: 'launch/a.yaml', line: 3 };
    const ofNode = fault('process', 'launch/a.yaml');
    useSessionStore.setState({
      launchNodes: [{ ...node, state: 'failed', restarts: 0, end: '' }],
      faults: [fault('exception', 'actions/Go.py'), ofNode],
      executorReason: 'It ended.',
    });
    act(() => useProjectStore.getState().addFile('notes.md', ''));
    expect(useSessionStore.getState()).toMatchObject({ faults: [ofNode], executorReason: '' });
  });

  it('open no older fault when a newer one is dismissed', () => {
    const [first, second] = [fault('exception', 'actions/Go.py'), fault('load', 'actions/Go.py')];
    act(() => useSessionStore.setState({ faults: [first, second] }));
    expect(openFile).toHaveBeenCalledOnce();
    act(() => useSessionStore.setState({ faults: [first] }));
    expect(openFile).toHaveBeenCalledOnce();
  });
});
