import { act, screen } from '@testing-library/react';
import { afterEach, describe, expect, it, vi } from 'vitest';
import type { Diagnostic } from '@/api/types';
import type { TopicMismatch } from '@/generated/messages';
import { setLanguage } from '@/i18n';
import { useLanguageStore } from '@/store/language';
import * as looking from '@/store/moment/looking';
import { useProjectStore } from '@/store/project';
import { initialSession } from '@/store/session/reduce';
import { useSessionStore } from '@/store/session/store';
import { segmentOf } from '../../../harness/runs';
import { nodeOf, openProject, show, user, watchNavigation } from '../../../harness/testing';
import { ProblemsPanel } from './ProblemsPanel';

const finding = (more: Partial<Diagnostic>): Diagnostic => ({
  code: 'X1',
  severity: 'error',
  message: 'It is wrong.',
  ...more,
});

function open(...diagnostics: Diagnostic[]) {
  return openWith('100', ...diagnostics);
}

function openWith(msec: string, ...diagnostics: Diagnostic[]) {
  openProject({
    trees: {
      Main: { r: { type: 'Sequence', children: ['a'] }, a: { type: 'Sleep', ports: { msec } } },
      Dock: { d: { type: 'AlwaysSuccess' } },
    },
    texts: { 'actions/Go.py': 'x = = 1' },
    diagnostics,
  });
  show(<ProblemsPanel />);
  return watchNavigation();
}

const rows = () => screen.getAllByRole('listitem').map((row) => row.querySelector('button')!);

afterEach(() => {
  act(() => setLanguage('en'));
  useSessionStore.setState(initialSession, true);
  useLanguageStore.setState(useLanguageStore.getInitialState(), true);
});

describe('ProblemsPanel', () => {
  it('shows that the project can run', () => {
    open();
    expect(screen.getByText('No problems: the project can run.')).toBeInTheDocument();
    expect(screen.queryByRole('list')).toBeNull();
  });

  it('lists errors before warnings before notes', () => {
    open(
      finding({ severity: 'note', message: 'Note.' }),
      finding({ severity: 'warning', message: 'Odd.' }),
      finding({ severity: 'error', message: 'Bad.' }),
    );
    const severities = screen.getAllByRole('img').map((icon) => icon.getAttribute('aria-label'));
    expect(severities).toEqual(['Error', 'Warning', 'Note']);
  });

  it('names the block, the port and the place', () => {
    open(
      finding({ tree: 'Dock', node: 'd', port: 'speed' }),
      finding({ file: 'actions/Go.py', line: 3 }),
      finding({ tree: 'Dock' }),
    );
    const [block, tree, line] = rows();
    expect(block).toHaveTextContent('AlwaysSuccess · port speed · Dock');
    expect(line).toHaveTextContent('actions/Go.py:3');
    expect(tree).toHaveTextContent(/Dock$/);
  });

  it('opens the block', async () => {
    const { openTree } = open(finding({ tree: 'Dock', node: 'd' }));
    await user.click(rows()[0]!);
    expect(openTree).toHaveBeenCalledWith('Dock');
    expect(useProjectStore.getState()).toMatchObject({
      selection: ['d'],
      revealed: { tree: 'Dock', node: 'd' },
    });
  });

  it('opens the line, the file or the tree', async () => {
    const { openFile, openTree } = open(
      finding({ file: 'a.py', line: 3 }),
      finding({ file: 'b.py' }),
      finding({ tree: 'Dock' }),
    );
    for (const row of rows()) await user.click(row);
    expect(openFile.mock.calls).toEqual([
      ['a.py', 3],
      ['b.py', undefined],
    ]);
    expect(openTree.mock.calls).toEqual([['Dock']]);
  });

  it('fixes a finding in one step of undo', async () => {
    openWith('{', finding({ code: 'BT0203', tree: 'Main', node: 'a', port: 'msec' }));
    const fixes = screen.queryAllByTestId(/^fix-/);
    expect(fixes.length).toBeGreaterThan(0);
    await user.click(fixes[0]!);
    expect(nodeOf('Main', 'a')?.ports?.['msec']).toBe('{msec}');
    act(() => {
      useProjectStore.getState().undo();
    });
    expect(nodeOf('Main', 'a')?.ports?.['msec']).toBe('{');
  });

  it('shows the message and the hint, and has the code in its tip', () => {
    open(finding({ hint: 'Do this.', severity: 'warning' }), finding({ code: 'X2', message: 'No hint.' }));
    const [error, warning] = rows();
    expect(error).toHaveTextContent(/No hint\.$/);
    expect(warning).toHaveTextContent(/It is wrong. Do this\.$/);
    expect(warning).toHaveAttribute('title', 'X1');
    expect(warning?.dataset).toMatchObject({ severity: 'warning', code: 'X1' });
    expect(screen.getByRole('list', { name: 'Problems' })).toBeInTheDocument();
  });

  it('keeps the order of findings of one severity', () => {
    open(finding({ code: 'A' }), finding({ code: 'B', severity: 'note' }), finding({ code: 'C' }));
    expect(rows().map(({ dataset }) => dataset['code'])).toEqual(['A', 'C', 'B']);
  });

  it('offers no fixes for a deleted block', () => {
    open(finding({ code: 'BT0203', tree: 'Main', node: 'gone', port: 'msec' }));
    expect(screen.queryAllByTestId(/^fix-/)).toEqual([]);
  });

  it('lists a wrong value before it is saved', () => {
    openWith('{');
    expect(rows().map(({ dataset }) => dataset['code'])).toEqual(['BT0203']);
    expect(screen.queryByText(/can run/)).toBeNull();
  });

  it('lists the fault of the run, and opens its line', async () => {
    const { openFile } = open();
    const fault = {
      kind: 'exception',
      message: 'NameError: twst',
      hint: '',
      node_id: 'a',
      tree_id: 'Main',
      node_path: 'Main/Sleep',
      file: 'actions/Go.py',
      line: 1,
      traceback: '',
    } as const;
    act(() => useSessionStore.setState({ faults: [fault] }));
    expect(rows()[0]).toHaveTextContent('NameError: twst Sleep · actions/Go.py:1Last run');
    await user.click(rows()[0]!);
    expect(openFile).toHaveBeenCalledWith('actions/Go.py', 1);
  });

  it.each([
    ['en', 'Nothing arrives on /scan: /world publishes a/msg/A, /ears subscribes to b/msg/B.', 'Topic'],
    ['es', 'No llega nada por /scan: /world publica a/msg/A y /ears se suscribe a b/msg/B.', 'Tópico'],
  ] as const)(
    'lists a topic whose ends do not match, in %s, and leads to the topics',
    async (language, text, kind) => {
      act(() => setLanguage(language));
      const { openTopics } = open();
      const mismatch: TopicMismatch = {
        topic: '/scan',
        publisher: '/world',
        subscriber: '/ears',
        reason: 'type',
        message: '',
        hint: '',
        code: 'type',
        values: { published: 'a/msg/A', wanted: 'b/msg/B' },
        resolved: false,
      };
      act(() => useSessionStore.setState({ mismatches: [mismatch] }));
      expect(rows()[0]).toHaveTextContent(text);
      expect(rows()[0]).toHaveTextContent(new RegExp(`/scan${kind}$`));
      await user.click(rows()[0]!);
      expect(openTopics).toHaveBeenCalledOnce();
      act(() => useSessionStore.setState({ mismatches: [] }));
      expect(screen.queryByRole('list')).toBeNull();
    },
  );

  it('lists the findings in a text, and opens their lines', async () => {
    const { openFile } = open();
    const place = { line: 2, character: 4 };
    const served = {
      from: place,
      to: place,
      severity: 'error',
      message: 'No such name.',
      source: 'ty x',
    } as const;
    act(() => useLanguageStore.setState({ findings: { 'actions/Go.py': [served] } }));
    expect(rows()[0]).toHaveTextContent(/No such name. actions\/Go.py:3$/);
    expect(rows()[0]).toHaveAttribute('title', 'ty x');
    await user.click(rows()[0]!);
    expect(openFile).toHaveBeenCalledWith('actions/Go.py', 3);
  });

  it("uses the editor's text if the editor has the same finding", () => {
    openWith('{', finding({ code: 'BT0203', tree: 'Main', node: 'a', port: 'msec', message: 'Server.' }));
    expect(rows()[0]).toHaveTextContent('has a brace without its partner');
    expect(rows()[0]).not.toHaveTextContent('Server.');
  });
});

it('goes to the moment of a fault of the run, where the run was recorded', async () => {
  const go = vi.spyOn(looking, 'goToFault').mockResolvedValue(true);
  const fault = { kind: 'exception', message: 'It broke.', hint: '', node_id: '', tree_id: '' } as const;
  const rest = { node_path: '', file: '', line: 0, traceback: '' };
  useSessionStore.setState({ faults: [{ ...fault, ...rest }] });
  open();
  expect(screen.queryByTestId('fault-moment')).toBeNull();
  act(() => useSessionStore.setState({ segments: [segmentOf({ run: 'a', to_t: 3, bytes: 10 })] }));
  await user.click(screen.getByRole('button', { name: 'Show the moment' }));
  expect(go).toHaveBeenCalledExactlyOnceWith('It broke.');
});

it('says that a recording does not hold the fault', async () => {
  vi.spyOn(looking, 'goToFault').mockResolvedValue(false);
  const fault = { kind: 'exception', message: 'It broke.', hint: '', node_id: '', tree_id: '' } as const;
  const rest = { node_path: '', file: '', line: 0, traceback: '' };
  const segments = [segmentOf({ run: 'a', to_t: 3, bytes: 10 })];
  useSessionStore.setState({ faults: [{ ...fault, ...rest }], segments });
  open();
  await user.click(screen.getByRole('button', { name: 'Show the moment' }));
  expect(await screen.findByText('The recording does not hold this fault.')).toBeInTheDocument();
});
