import { screen, within } from '@testing-library/react';
import { beforeEach, describe, expect, it } from 'vitest';
import { useFileDialog } from '@/store/dialogs/files';
import { useProjectStore } from '@/store/project';
import { useScope } from '@/store/revisions/scope';
import { loadLayout } from '@/workspace/layoutModel';
import { openDocuments, useTabs } from '@/workspace/tabs';
import { openProject, show, user } from '../../../harness/testing';
import { Explorer } from './Explorer';

const files = () => useProjectStore.getState().files;
const tabs = () => openDocuments(useTabs.getState().model!);

async function choose(name: string, item: string) {
  await user.click(screen.getByRole('button', { name: `More for ${name}` }));
  await user.click(await screen.findByRole('menuitem', { name: item }));
}

describe('Explorer', () => {
  beforeEach(() => {
    const block = { d: { type: 'AlwaysSuccess' } };
    openProject({
      trees: { Main: block, Dock: block },
      texts: {
        'project.json': '{}',
        'actions/Turn.py': 'class Turn: ...',
        'universes/hall.yaml': 'a: 1',
        'robots/mine/robot.yaml': 'b: 1',
        'robots/mine/body.urdf': '<robot/>',
        'README.md': 'Hello',
      },
      diagnostics: [
        { code: 'BT0114', severity: 'warning', message: 'odd', tree: 'Dock' },
        { code: 'BT0301', severity: 'warning', message: 'odd', file: 'actions/Turn.py' },
        { code: 'BT0302', severity: 'error', message: 'bad', file: 'actions/Turn.py' },
      ],
    });
    useTabs.setState({ model: loadLayout('wide', false), width: 'wide', front: null });
    useFileDialog.setState({ dialog: null });
    show(<Explorer />);
  });

  it('lists the files by kind, in order', () => {
    const names = Object.fromEntries(
      ['Trees', 'Actions', 'Worlds', 'Robots', 'Other files'].map((title) => {
        const items = within(screen.getByRole('region', { name: title })).queryAllByRole('listitem');
        return [title, items.map((item) => item.textContent)];
      }),
    );
    expect(names).toEqual({
      Trees: ['Dock', 'Main'],
      Actions: ['Turn.py'],
      Worlds: ['hall.yaml'],
      Robots: ['mine'],
      'Other files': ['README.md', 'project.json', 'robots/mine/body.urdf'],
    });
  });

  it('marks the main tree, and files with errors and warnings', () => {
    expect(within(screen.getByTestId('file-trees/Main.json')).getByRole('img')).toHaveAccessibleName(
      'The tree that Run starts',
    );
    expect(within(screen.getByTestId('file-trees/Dock.json')).queryByRole('img')).toBeNull();
    const severity = (path: string) => screen.getByTestId(`file-${path}`).parentElement?.dataset['severity'];
    expect(severity('trees/Dock.json')).toBe('warning');
    expect(severity('actions/Turn.py')).toBe('error');
    expect(severity('README.md')).toBeUndefined();
  });

  it('opens trees as trees and other files as text', async () => {
    await user.click(screen.getByTestId('file-trees/Dock.json'));
    await user.click(screen.getByTestId('file-README.md'));
    expect(tabs()).toEqual([
      { kind: 'tree', id: 'Dock' },
      { kind: 'file', path: 'README.md' },
    ]);
  });

  it.each([
    ['New tree', 'tree'],
    ['New action', 'action'],
    ['New file', 'file'],
  ])('%s opens the dialogue for it', async (label, kind) => {
    await user.click(screen.getByRole('button', { name: label }));
    expect(useFileDialog.getState().dialog).toEqual({ mode: 'new', kind });
  });

  it('makes another tree the main tree', async () => {
    await choose('Dock', 'Make it the main tree');
    expect(useProjectStore.getState().mainTree).toBe('Dock');
    expect(useProjectStore.getState().settings?.main_tree).toBe('Dock');
  });

  it('asks for the new name of a file', async () => {
    await choose('Turn.py', 'Rename');
    expect(useFileDialog.getState().dialog).toEqual({ mode: 'rename', path: 'actions/Turn.py' });
  });

  it('shows the history of one file', async () => {
    useScope.setState({ scope: 'project' });
    await choose('README.md', 'History');
    expect(tabs()).toEqual([{ kind: 'file', path: 'README.md' }]);
    expect(useScope.getState().scope).toBe('file');
  });

  it('deletes a file, and restores it', async () => {
    await choose('README.md', 'Delete');
    expect(await screen.findByText('README.md was deleted.')).toBeInTheDocument();
    expect(screen.queryByTestId('file-README.md')).toBeNull();
    await user.click(screen.getByRole('button', { name: 'Undo' }));
    expect(files()['README.md']?.text).toBe('Hello');
    expect(screen.getByTestId('file-README.md')).toBeInTheDocument();
  });

  it('deletes a robot with its folder, and a tree with its tab', async () => {
    await choose('mine', 'Delete');
    expect(await screen.findByText(/mine was deleted, with one more file/)).toBeInTheDocument();
    expect(Object.keys(files()).filter((path) => path.startsWith('robots/'))).toEqual([]);
    await user.click(screen.getByTestId('file-trees/Dock.json'));
    await choose('Dock', 'Delete');
    expect(await screen.findByText('Dock was deleted.')).toBeInTheDocument();
    expect(tabs()).toEqual([]);
  });

  it('does not delete the main tree and the settings', async () => {
    await user.click(screen.getByRole('button', { name: 'More for Main' }));
    expect(await screen.findByRole('menuitem', { name: 'Delete' })).toBeDisabled();
    expect(screen.queryByRole('menuitem', { name: 'Make it the main tree' })).toBeNull();
    expect(screen.queryByRole('button', { name: 'More for project.json' })).toBeNull();
  });
});
