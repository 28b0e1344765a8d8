import { act, screen, waitFor } from '@testing-library/react';
import { beforeEach, describe, expect, it, onTestFinished } from 'vitest';
import {
  closeFileDialog,
  openNewFile,
  openRename,
  useFileDialog,
  type NewFileKind,
} from '@/store/dialogs/files';
import { useProjectStore } from '@/store/project';
import { fakeServer, openProject, show, user, watchNavigation } from '../../../harness/testing';
import { FileDialog } from './FileDialog';
import { ACTION_TEMPLATES } from './templates';

const store = () => useProjectStore.getState();
const field = () => screen.getByRole('textbox') as HTMLInputElement;
const ok = () => user.click(screen.getByTestId('file-dialog-ok'));
const isOpen = () => useFileDialog.getState().dialog !== null;
let navigator: ReturnType<typeof watchNavigation>;

beforeEach(() => {
  fakeServer({});
  openProject({
    trees: { Main: { r: { type: 'Sequence', children: ['a'] }, a: { type: 'Turn' } } },
    texts: { 'actions/Turn.py': 'class Turn:\n    pass\n', 'notes.md': 'words' },
  });
  navigator = watchNavigation();
  onTestFinished(closeFileDialog);
  show(<FileDialog />);
});

const openNew = (kind: NewFileKind) => act(() => openNewFile(kind));
const rename = (path: string) => act(() => openRename(path));

async function name(words: string) {
  await user.clear(field());
  await user.type(field(), words);
}

describe('a new file', () => {
  it.each([
    ['action', 'New action', 'Name of the class and its file', 'FollowWall'],
    ['tree', 'New tree', 'Name of the tree', 'Patrol'],
    ['file', 'New file', 'Path in the project', 'assets/notes.md'],
  ] as const)('%s asks for its name', (kind, title, label, example) => {
    expect(screen.queryByRole('dialog')).toBeNull();
    openNew(kind);
    expect(screen.getByRole('dialog', { name: title })).toBeInTheDocument();
    expect(field()).toHaveAccessibleName(label);
    expect(field()).toHaveAttribute('placeholder', example);
    expect(field()).toHaveValue('');
    expect(screen.queryAllByRole('radio')).toHaveLength(kind === 'action' ? ACTION_TEMPLATES.length : 0);
    expect(screen.getByTestId('file-dialog-ok')).toHaveTextContent('Create');
  });

  it('is an action, from a template', async () => {
    openNew('action');
    await name('Stop');
    await user.click(screen.getByRole('radio', { name: /Condition/ }));
    await ok();
    expect(store().currentText('actions/Stop.py')).toContain('NODE_KIND = "Condition"');
    expect(navigator.openFile).toHaveBeenCalledWith('actions/Stop.py', undefined);
    expect(isOpen()).toBe(false);
  });

  it('is an action that does something, unless another template is chosen', async () => {
    openNew('action');
    await name('Stop{Enter}');
    expect(store().currentText('actions/Stop.py')).toContain('"speed": Port(float');
  });

  it('is a tree', async () => {
    openNew('tree');
    await name('Patrol');
    await ok();
    expect(store().diagrams['Patrol']).toMatchObject({ id: 'Patrol' });
    expect(navigator.openTree).toHaveBeenCalledWith('Patrol');
    expect(navigator.openFile).not.toHaveBeenCalled();
  });

  it('is an empty file', async () => {
    openNew('file');
    await name('assets/a.md');
    await ok();
    expect(store().currentText('assets/a.md')).toBe('');
    expect(navigator.openFile).toHaveBeenCalledWith('assets/a.md', undefined);
  });

  it('is enums.json with an example', async () => {
    openNew('file');
    await name('enums.json');
    await ok();
    expect(store().currentText('enums.json')).toContain('"RED": 0');
  });

  it('needs a valid name, and reports that once something was typed', async () => {
    openNew('action');
    expect(screen.queryByText('A name is needed.')).toBeNull();
    await ok();
    expect(screen.getByText('A name is needed.')).toBeInTheDocument();
    await name('Turn');
    expect(screen.getByText('This name is already in use.')).toBeInTheDocument();
    await name('3D');
    expect(screen.getByText(/Letters, digits and _ only/)).toBeInTheDocument();
    await ok();
    expect(isOpen()).toBe(true);
    await user.clear(field());
    expect(screen.queryByText('A name is needed.')).toBeNull();
  });

  it('is not made after Cancel', async () => {
    openNew('tree');
    await name('Patrol');
    await user.click(screen.getByRole('button', { name: 'Cancel' }));
    expect(isOpen()).toBe(false);
    expect(store().diagrams['Patrol']).toBeUndefined();
  });
});

describe('another name', () => {
  it('of an action also renames its blocks', async () => {
    rename('actions/Turn.py');
    expect(screen.getByRole('dialog', { name: 'Rename' })).toBeInTheDocument();
    expect(screen.getByTestId('file-dialog-ok')).toHaveTextContent('Rename');
    expect(field()).toHaveValue('Turn');
    expect(screen.queryByRole('radio')).toBeNull();
    await name('Spin');
    await ok();
    expect(store().currentText('actions/Spin.py')).toContain('class Spin');
    expect(store().currentText('actions/Turn.py')).toBeNull();
    expect(store().diagrams['Main']?.nodes['a']?.type).toBe('Spin');
    expect(navigator.openFile).toHaveBeenCalledWith('actions/Spin.py', undefined);
  });

  it('of a tree', async () => {
    rename('trees/Main.json');
    await name('Patrol');
    await ok();
    expect(Object.keys(store().diagrams)).toEqual(['Patrol']);
    expect(navigator.openTree).toHaveBeenCalledWith('Patrol');
  });

  it('of any other file', async () => {
    rename('notes.md');
    await name('docs/notes.md');
    await ok();
    await waitFor(() => expect(navigator.openFile).toHaveBeenCalledWith('docs/notes.md', undefined));
    expect(store().currentText('docs/notes.md')).toBe('words');
    expect(store().currentText('notes.md')).toBeNull();
  });

  it('that is unchanged changes nothing', async () => {
    rename('actions/Turn.py');
    await ok();
    expect(isOpen()).toBe(false);
    expect(store().changeCounter).toBe(0);
    expect(navigator.openFile).not.toHaveBeenCalled();
  });

  it('must not be taken', async () => {
    rename('notes.md');
    await name('actions/Turn.py');
    await ok();
    expect(screen.getByText('This name is already in use.')).toBeInTheDocument();
    expect(isOpen()).toBe(true);
  });
});
