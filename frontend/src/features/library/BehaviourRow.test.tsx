import { screen, within } from '@testing-library/react';
import { beforeEach, describe, expect, it } from 'vitest';
import { useProjectStore } from '@/store/project';
import { oneBlock } from '@/store/testing';
import { fakeServer, openProject, show, user } from '../../../harness/testing';
import { ArrivalsDialog } from './ArrivalsDialog';
import { BehaviourRow } from './BehaviourRow';
import type { Offer } from './useReusables';

const text = oneBlock('Dock', 'AlwaysSuccess');
const offer: Offer = {
  id: 'Dock',
  source: 'library',
  version: '1.2',
  group: 'motion',
  summary: 'Goes home.',
  doc: 'Looks for the dock first.',
  diagram: JSON.parse(text) as unknown,
  project: null,
  owner: null,
  isOffered: true,
  files: { 'trees/Dock.json': text, 'actions/Dock.py': 'class Dock: ...' },
};

beforeEach(() => {
  fakeServer({});
  openProject({ trees: { Main: { r: { type: 'Sequence', children: [] } } } });
});

function open(takenVersion: string | null = null, more: Partial<Offer> = {}) {
  show(
    <>
      <BehaviourRow offer={{ ...offer, ...more }} takenVersion={takenVersion} />
      <ArrivalsDialog />
    </>,
  );
  return within(screen.getByTestId('behaviour-Dock'));
}
const unfold = () => user.click(screen.getByRole('button', { name: 'Dock' }));

describe('a behaviour', () => {
  it('has a summary, and its details on demand', async () => {
    const row = open();
    expect(row.getByText('Goes home.')).toBeInTheDocument();
    expect(row.getByRole('button', { name: 'Dock' })).toHaveAttribute('aria-expanded', 'false');
    expect(row.queryByText('Version 1.2')).toBeNull();
    await unfold();
    expect(row.getByRole('button', { name: 'Dock' })).toHaveAttribute('aria-expanded', 'true');
    expect(row.getByText('Looks for the dock first.')).toBeInTheDocument();
    expect(row.getByText('Version 1.2')).toBeInTheDocument();
    expect(row.queryByText(/^Here:/)).toBeNull();
    expect(row.getByText('Brings 2 files')).toBeInTheDocument();
    expect(row.getAllByRole('listitem').map(({ textContent }) => textContent)).toEqual([
      'trees/Dock.json',
      'actions/Dock.py',
    ]);
    await unfold();
    expect(row.queryByText('Version 1.2')).toBeNull();
  });

  it('leaves out an empty description', async () => {
    const row = open(null, { doc: '' });
    await unfold();
    expect(row.queryByText('Looks for the dock first.')).toBeNull();
  });

  it('can be updated if the project has another version', async () => {
    const row = open('1.1');
    expect(row.getByTestId('update-Dock')).toBeInTheDocument();
    await unfold();
    expect(row.getByText('Here: 1.1')).toBeInTheDocument();
  });

  it('says where its state comes from if that is a project', async () => {
    const row = open('r3', { version: 'r7', project: 'Rover' });
    await unfold();
    expect(row.getByText('As it is now in Rover')).toBeInTheDocument();
    expect(row.getByText('Here: as it was earlier')).toBeInTheDocument();
    expect(row.queryByText(/r3|r7/)).toBeNull();
  });

  it.each([null, '1.2'])('is not updated where the project has %s', (taken) => {
    expect(open(taken).queryByTestId('update-Dock')).toBeNull();
  });

  it('shows what an update changes, and closes', async () => {
    open('1.1');
    await user.click(screen.getByTestId('update-Dock'));
    expect(await screen.findByRole('dialog', { name: 'Dock: changes in version 1.2' })).toBeInTheDocument();
    await user.click(screen.getAllByRole('button', { name: 'Cancel' }).at(-1)!);
    expect(screen.queryByTestId('confirm-update')).toBeNull();
  });
});

describe('a behaviour that is inserted', () => {
  it('brings its files, and reports that', async () => {
    open();
    await user.click(screen.getByRole('button', { name: 'Insert Dock' }));
    const { diagrams, currentText } = useProjectStore.getState();
    expect(diagrams['Dock']?.root).toBe('n1');
    expect(currentText('actions/Dock.py')).toBe('class Dock: ...');
    expect(await screen.findByText('Dock is in the tree, with its actions.')).toBeInTheDocument();
  });

  it('is taken back with its files, in one step', async () => {
    useProjectStore.getState().setActiveTree('Main');
    open();
    await user.click(screen.getByTestId('insert-Dock'));
    expect(useProjectStore.getState().currentText('assets/library.json')).toContain('1.2');
    useProjectStore.getState().undo();
    expect(useProjectStore.getState().pendingChanges()).toEqual([]);
    useProjectStore.getState().redo();
    expect(useProjectStore.getState().currentText('actions/Dock.py')).toBe('class Dock: ...');
  });

  it('has another name where the project has a tree of that name', async () => {
    useProjectStore.getState().addFile('trees/Dock.json', oneBlock('Dock', 'AlwaysFailure'));
    open();
    await user.click(screen.getByTestId('insert-Dock'));
    expect(await screen.findByRole('dialog', { name: 'Insert Dock' })).toBeInTheDocument();
    await user.click(screen.getByTestId('take-arrivals'));
    expect(await screen.findByText(/^This project already has another Dock/)).toBeInTheDocument();
    const { diagrams } = useProjectStore.getState();
    expect(diagrams['Dock']?.nodes['n1']?.type).toBe('AlwaysFailure');
    expect(Object.keys(diagrams)).toHaveLength(3);
  });
});
