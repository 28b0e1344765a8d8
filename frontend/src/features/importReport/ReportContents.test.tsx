import { act, screen } from '@testing-library/react';
import { beforeEach, describe, expect, it } from 'vitest';
import { announceImport, useImportReport, type Proposal } from '@/store/dialogs/importReport';
import { useUniverseChooser } from '@/store/dialogs/universeChooser';
import type { Diagnostic } from '@/api/types';
import { translates } from '@/i18n';
import { useProjectStore } from '@/store/project';
import { action, openProject, show, user, watchNavigation } from '../../../harness/testing';
import { ReportContents } from './ReportContents';
import { ImportReport } from './ImportReport';

const stub: Diagnostic = {
  code: 'BT0613',
  severity: 'warning',
  message: 'The action Grab is only a stub.',
  file: 'trees/Main.json',
  line: 8,
  tree: 'Main',
  node: 'b',
  values: { name: 'Grab', path: 'actions/Grab.py' },
};
const nodes = { a: { type: 'Sequence', children: ['b'] }, b: { type: 'AlwaysSuccess' } };

function open(diagnostics: readonly Diagnostic[] = [], proposal: Proposal = null) {
  openProject({
    trees: { Main: nodes },
    actions: [action('Grab', { kind: 'condition' })],
    texts: { 'actions/Grab.py': 'class Grab: pass\n', 'imports/patrol.xml': '<root/>' },
    diagnostics,
  });
  announceImport('p1', 'patrol.xml', proposal);
  show(<ImportReport projectId="p1" />);
}

beforeEach(() => useImportReport.setState({ projectId: null, file: '', proposal: null, oneBlock: '' }));

describe('ReportContents', () => {
  it('says what was imported, and that nothing is missing', async () => {
    open();
    expect(screen.getByRole('dialog', { name: 'Imported from patrol.xml' })).toBeInTheDocument();
    expect(screen.getByTestId('import-report')).toHaveTextContent('1 tree1 action1 other file');
    expect(screen.getByText('Nothing is missing: press Run.')).toBeInTheDocument();
    expect(screen.queryByTestId('open-first-problem')).toBeNull();
    await user.click(screen.getByRole('button', { name: 'Done' }));
    expect(useImportReport.getState().projectId).toBeNull();
  });

  it('lists the stubs with their kinds, and opens the first', async () => {
    const { openFile } = watchNavigation();
    open([stub]);
    expect(screen.getByRole('button', { name: 'Grab condition' })).toBeInTheDocument();
    await user.click(screen.getByTestId('open-first-problem'));
    expect(openFile).toHaveBeenCalledExactlyOnceWith('actions/Grab.py');
    expect(useImportReport.getState().projectId).toBeNull();
  });

  it('lists errors before stubs, each with its hint', async () => {
    const { openTree } = watchNavigation();
    const missing = {
      code: 'X1',
      severity: 'error',
      message: 'No such tree.',
      hint: 'Make it.',
      tree: 'Main',
    } as const;
    open([stub, { ...missing, node: 'b' }]);
    await user.click(screen.getByRole('button', { name: 'No such tree. Make it.' }));
    expect(openTree).toHaveBeenCalledWith('Main');
  });

  it('says why it proposes this universe, as long as it is this one', () => {
    open([], { universe: 'line', topics: '/camera/image_raw' });
    expect(screen.queryByTestId('import-reason')).toBeNull();
    act(() => useProjectStore.getState().setSettings({ universe: 'line' }));
    expect(screen.getByTestId('import-reason')).toHaveTextContent(
      /because the actions use \/camera\/image_raw/,
    );
  });

  it.each(['walled_room', 'person_in_green', 'line', 'warehouse'])('has a reason for %s', (universe) => {
    expect(translates(`importReport:reason.${universe}`)).toBe(true);
  });

  it('says why a tree of py_trees is one block', () => {
    open();
    expect(screen.queryByTestId('one-block')).toBeNull();
    act(() => announceImport('p1', 'robot.py', null, 'a class has no form'));
    expect(screen.getByTestId('one-block')).toHaveTextContent(
      /^The tree is one block here, since a class has no form\./,
    );
  });

  it('offers another universe', async () => {
    open();
    await user.click(screen.getByRole('button', { name: 'Choose another world…' }));
    expect(useUniverseChooser.getState().isOpen).toBe(true);
    expect(useImportReport.getState().projectId).toBeNull();
  });
});

it('is shown without a dialogue', () => {
  openProject({ trees: { Main: nodes } });
  show(<ReportContents />);
  expect(screen.getByTestId('import-report')).toHaveTextContent('1 tree');
});
