import { act, screen, waitFor } from '@testing-library/react';
import { beforeEach, describe, expect, it } from 'vitest';
import { useProjectStore } from '@/store/project';
import { useUniverseChoice } from '@/store/run/universeChoice';
import { loadLayout } from '@/workspace/layoutModel';
import { openDocuments, openTab, useTabs } from '@/workspace/tabs';
import { fakeServer, openProject, show, user } from '../../../harness/testing';
import { removeDocument } from './removing';

const store = () => useProjectStore.getState();
const paths = () =>
  Object.keys(store().files)
    .filter((path) => path.startsWith('robots/'))
    .sort();
const tabs = () => openDocuments(useTabs.getState().model!);
const remove = (path: string) => act(() => removeDocument(path));
const undo = async () => user.click(await screen.findByRole('button', { name: 'Undo' }));

function open(answers: Record<string, unknown> = {}) {
  const server = fakeServer(answers);
  openProject({
    trees: { Main: { r: { type: 'Sequence' } }, Dock: { d: { type: 'Sleep', name: 'Nap' } } },
    texts: {
      'project.json': '{}',
      'universes/hall.yaml': 'a: 1',
      'robots/mine/robot.yaml': 'b: 1',
      'robots/mine/body.urdf': '<robot/>',
      'robots/other/robot.yaml': 'c: 1',
      'README.md': 'Hello',
    },
  });
  useTabs.setState({ model: loadLayout('wide', false), width: 'wide', front: null });
  show(<div />);
  return server;
}

beforeEach(() => {
  useUniverseChoice.setState({ universe: null, robot: null });
});

describe('a document that is removed', () => {
  it('loses its tab, and can be restored', async () => {
    open();
    openTab({ kind: 'tree', id: 'Dock' });
    openTab({ kind: 'file', path: 'README.md' });
    await remove('trees/Dock.json');
    expect(await screen.findByText('Dock was deleted.')).toBeInTheDocument();
    expect(tabs()).toEqual([{ kind: 'file', path: 'README.md' }]);
    expect(store().diagrams['Dock']).toBeUndefined();
    await undo();
    expect(store().diagrams['Dock']?.nodes['d']?.name).toBe('Nap');
    await remove('README.md');
    expect(tabs()).toEqual([]);
  });

  it('is deleted with its folder, if it is a robot', async () => {
    open();
    await remove('robots/mine/robot.yaml');
    expect(
      await screen.findByText('mine was deleted, with one more file of its folder.'),
    ).toBeInTheDocument();
    expect(paths()).toEqual(['robots/other/robot.yaml']);
    await undo();
    expect(paths()).toEqual(['robots/mine/body.urdf', 'robots/mine/robot.yaml', 'robots/other/robot.yaml']);
    expect(store().currentText('robots/mine/body.urdf')).toBe('<robot/>');
  });

  it('is removed from the settings until it is restored', async () => {
    open();
    act(() => store().setSettings({ universe: 'hall' }));
    await remove('universes/hall.yaml');
    expect(
      await screen.findByText('hall was deleted. The project does not run with it any more.'),
    ).toBeInTheDocument();
    expect(store().settings?.universe).toBe('empty');
    await undo();
    expect(store().settings?.universe).toBe('hall');
  });

  it.each([
    ['universes/hall.yaml', { universe: 'hall', robot: 'x' }, { universe: null, robot: null }],
    ['robots/mine/robot.yaml', { universe: 'y', robot: 'mine' }, { universe: null, robot: null }],
    ['README.md', { universe: 'hall', robot: 'mine' }, { universe: 'hall', robot: 'mine' }],
  ])('%s is not the choice of the next run', async (path, before, after) => {
    open();
    useUniverseChoice.setState(before);
    await remove(path);
    expect(useUniverseChoice.getState()).toMatchObject(after);
  });
});

describe('a binary file', () => {
  const binary = () =>
    act(() =>
      useProjectStore.setState(({ files }) => ({
        files: {
          ...files,
          'robots/mine/body.stl': {
            path: 'robots/mine/body.stl',
            kind: 'binary',
            text: null,
            revision: 1,
            savedText: null,
          },
        },
      })),
    );

  it('is fetched before it is deleted, and restored', async () => {
    const server = open({
      'GET /projects/p1/files/robots/mine/body.stl': new Response(new Uint8Array([1, 2, 3])),
    });
    binary();
    await remove('robots/mine/robot.yaml');
    expect(server.requests.map(({ path }) => path)).toEqual(['/projects/p1/files/robots/mine/body.stl']);
    expect(await screen.findByText('mine was deleted, with 2 more files of its folder.')).toBeInTheDocument();
    expect(paths()).toEqual(['robots/other/robot.yaml']);
    await undo();
    await waitFor(() => {
      expect(server.requests.some(({ method }) => method !== 'GET')).toBe(true);
    });
  });

  it('that cannot be fetched is not removed', async () => {
    open();
    binary();
    await remove('robots/mine/robot.yaml');
    expect(await screen.findByText('robots/mine/body.stl: 404')).toBeInTheDocument();
    expect(paths()).toContain('robots/mine/robot.yaml');
    expect(screen.queryByRole('button', { name: 'Undo' })).toBeNull();
  });
});
