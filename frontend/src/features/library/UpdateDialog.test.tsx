import { EditorView } from '@codemirror/view';
import { screen } from '@testing-library/react';
import { beforeEach, describe, expect, it, vi } from 'vitest';
import { insertBehaviour, takenNow } from '@/store/project/library';
import { useProjectStore } from '@/store/project';
import { oneBlock } from '@/store/testing';
import { openProject, show, user } from '../../../harness/testing';
import { UpdateDialog } from './UpdateDialog';
import type { Offer } from './useReusables';

const onClose = vi.fn();
const offer = (version: string, source: string): Offer => ({
  id: 'Dock',
  source: 'library',
  version,
  group: 'motion',
  summary: '',
  doc: '',
  diagram: null,
  project: null,
  owner: null,
  isOffered: true,
  files: { 'trees/Dock.json': oneBlock('Dock', 'AlwaysSuccess'), 'actions/Dock.py': source },
});
const text = () => useProjectStore.getState().currentText('actions/Dock.py');
const textOf = (name: string) =>
  EditorView.findFromDOM(screen.getByRole('textbox', { name }))!.state.doc.toString();

beforeEach(() => {
  onClose.mockReset();
  openProject({ trees: { Main: { r: { type: 'Sequence', children: [] } } } });
  insertBehaviour(offer('1.0', 'class Dock: old'));
});

describe('UpdateDialog', () => {
  it('shows the files that change, before and after', () => {
    show(<UpdateDialog offer={offer('1.1', 'class Dock: new')} onClose={onClose} />);
    expect(screen.getByRole('dialog', { name: 'Dock: changes in version 1.1' })).toBeInTheDocument();
    expect(screen.getAllByTestId(/^difference-/).map(({ dataset }) => dataset['testid'])).toEqual([
      'difference-actions/Dock.py',
    ]);
    expect(textOf('actions/Dock.py as it is in this project')).toBe('class Dock: old');
    expect(textOf('actions/Dock.py as the update has it')).toBe('class Dock: new');
    expect(screen.queryByText(/The files are the same/)).toBeNull();
    expect(text()).toBe('class Dock: old');
  });

  it('names the project, not a number, where the tree comes from one', () => {
    const newer = { ...offer('r7', 'class Dock: new'), project: 'Rover' };
    show(<UpdateDialog offer={newer} onClose={onClose} />);
    expect(
      screen.getByRole('dialog', { name: 'Dock: changes that make it equal to the one in Rover' }),
    ).toBeInTheDocument();
  });

  it('updates', async () => {
    show(<UpdateDialog offer={offer('1.1', 'class Dock: new')} onClose={onClose} />);
    await user.click(screen.getByTestId('confirm-update'));
    expect(text()).toBe('class Dock: new');
    expect(takenNow()['library/Dock']?.version).toBe('1.1');
    expect(onClose).toHaveBeenCalledOnce();
  });

  it('changes nothing when it is cancelled', async () => {
    show(<UpdateDialog offer={offer('1.1', 'class Dock: new')} onClose={onClose} />);
    await user.click(screen.getAllByRole('button', { name: 'Cancel' }).at(-1)!);
    expect(text()).toBe('class Dock: old');
    expect(takenNow()['library/Dock']?.version).toBe('1.0');
    expect(onClose).toHaveBeenCalledOnce();
  });

  it('stores the version if no file changes', async () => {
    show(<UpdateDialog offer={offer('1.1', 'class Dock: old')} onClose={onClose} />);
    expect(screen.getByText('The files are the same; only the version is noted.')).toBeInTheDocument();
    expect(screen.queryByTestId(/^difference-/)).toBeNull();
    await user.click(screen.getByTestId('confirm-update'));
    expect(takenNow()['library/Dock']?.version).toBe('1.1');
  });
});
