import { act, screen } from '@testing-library/react';
import { beforeEach, describe, expect, it } from 'vitest';
import { setDescription } from '@/model/edits';
import { useFileDialog } from '@/store/dialogs/files';
import { useProjectStore } from '@/store/project';
import { useScope } from '@/store/revisions/scope';
import { loadLayout } from '@/workspace/layoutModel';
import { openDocuments, useTabs } from '@/workspace/tabs';
import { openProject, show, user } from '../../../harness/testing';
import { ExplorerItem } from './ExplorerItem';

const tabs = () => openDocuments(useTabs.getState().model!);
const item = (path: string) => screen.getByTestId(`file-${path}`);
const icon = (path: string) => item(path).querySelector('svg')!.getAttribute('class');

beforeEach(() => {
  openProject({
    trees: { Main: { r: { type: 'Sequence' } }, Dock: { d: { type: 'Sleep' } } },
    texts: { 'trees/Broken.json': '{', 'README.md': 'Hello' },
  });
  useTabs.setState({ model: loadLayout('wide', false), width: 'wide', front: null });
  useFileDialog.setState({ dialog: null });
});

const open = (path: string, isTree = false, isAction = false) =>
  show(<ExplorerItem path={path} isTree={isTree} isAction={isAction} worst={undefined} />);

async function menu(name: string) {
  await user.click(screen.getByRole('button', { name: `More for ${name}` }));
  await screen.findByRole('menuitem', { name: 'Rename' });
  return screen
    .getAllByRole('menuitem')
    .map((each) => [each.textContent, each.hasAttribute('data-disabled')]);
}

describe('a file', () => {
  it.each([
    ['trees/Dock.json', true, false, 'Dock', 'git-fork'],
    ['actions/Turn.py', false, true, 'Turn.py', 'file-code'],
    ['universes/hall.yaml', false, false, 'hall.yaml', 'world'],
    ['robots/mine/robot.yaml', false, false, 'mine', 'robot'],
    ['robots/mine/body.urdf', false, false, 'robots/mine/body.urdf', 'file-text'],
    ['README.md', false, false, 'README.md', 'file-text'],
  ])('%s has a name and an icon', (path, isTree, isAction, name, sign) => {
    open(path, isTree, isAction);
    expect(item(path)).toHaveTextContent(name);
    expect(item(path).textContent).toBe(name);
    expect(item(path)).toHaveAttribute('title', path);
    expect(icon(path)).toContain(sign);
  });

  it('opens in the editor for its kind', async () => {
    open('trees/Dock.json', true);
    open('trees/Broken.json', true);
    for (const path of ['trees/Dock.json', 'trees/Broken.json']) await user.click(item(path));
    expect(tabs()).toEqual([
      { kind: 'tree', id: 'Dock' },
      { kind: 'file', path: 'trees/Broken.json' },
    ]);
  });

  it('that is binary is not opened, and has no history', async () => {
    const path = 'mesh.stl';
    const entry = { path, kind: 'binary', text: null, revision: 1, savedText: null } as const;
    act(() => useProjectStore.setState(({ files }) => ({ files: { ...files, [path]: entry } })));
    open(path);
    expect(item(path)).toBeDisabled();
    expect(await menu(path)).toEqual([
      ['Open', true],
      ['Rename', false],
      ['Duplicate', true],
      ['Copy path', false],
      ['History', true],
      ['Delete', false],
    ]);
  });
});

describe('the menu', () => {
  it('of a tree makes it the main tree', async () => {
    open('trees/Dock.json', true);
    expect(screen.queryByRole('img')).toBeNull();
    expect(await menu('Dock')).toEqual([
      ['Open', false],
      ['Make it the main tree', false],
      ['Rename', false],
      ['Duplicate', false],
      ['Copy', false],
      ['Offer in the library', false],
      ['Copy path', false],
      ['History', false],
      ['Delete', false],
    ]);
    await user.click(screen.getByRole('menuitem', { name: 'Make it the main tree' }));
    expect(useProjectStore.getState().mainTree).toBe('Dock');
    expect(screen.getByRole('img', { name: 'The tree that Run starts' })).toBeInTheDocument();
  });

  it('of the main tree cannot delete it', async () => {
    open('trees/Main.json', true);
    expect(await menu('Main')).toEqual([
      ['Open', false],
      ['Rename', false],
      ['Duplicate', false],
      ['Copy', false],
      ['Offer in the library', false],
      ['Copy path', false],
      ['History', false],
      ['Delete', true],
    ]);
  });

  it('of a broken tree does not make it the main tree', async () => {
    open('trees/Broken.json', true);
    expect((await menu('Broken')).map(([words]) => words)).not.toContain('Make it the main tree');
  });

  it('renames, and shows the history', async () => {
    useScope.setState({ scope: 'project' });
    open('README.md');
    await menu('README.md');
    await user.click(screen.getByRole('menuitem', { name: 'Rename' }));
    expect(useFileDialog.getState().dialog).toEqual({ mode: 'rename', path: 'README.md' });
    await menu('README.md');
    await user.click(screen.getByRole('menuitem', { name: 'History' }));
    expect(useScope.getState().scope).toBe('file');
    expect(tabs()).toEqual([{ kind: 'file', path: 'README.md' }]);
  });

  it('is absent for the settings', () => {
    open('project.json');
    expect(screen.queryByRole('button', { name: /^More/ })).toBeNull();
  });
});

it.each(['error', 'warning', undefined] as const)('is marked with its worst finding: %s', (worst) => {
  show(<ExplorerItem path="README.md" isTree={false} isAction={false} worst={worst} />);
  expect(item('README.md').parentElement!.dataset['severity']).toBe(worst);
});

it('tells what a tree is for', () => {
  useProjectStore.getState().apply('Dock', 'describe', [setDescription('Goes home.')]);
  open('trees/Dock.json', true);
  expect(item('trees/Dock.json')).toHaveAttribute('title', 'trees/Dock.json\nGoes home.');
});
