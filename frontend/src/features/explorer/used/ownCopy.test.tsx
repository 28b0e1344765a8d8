import { act, screen, waitFor } from '@testing-library/react';
import { beforeEach, describe, expect, it } from 'vitest';
import { useProjectStore } from '@/store/project';
import { useUniverseChoice } from '@/store/run/universeChoice';
import { fakeServer, openProject, show, user, watchNavigation } from '../../../../harness/testing';
import { canCopy, makeOwnCopy, useCopying } from './ownCopy';

const ANSWERS = {
  'GET /catalog/universes/maze/text': new Response('name: Maze\nrobots: [{model: burger}]\n'),
  'GET /catalog/robots/burger/config': new Response('name: Burger\nurdf: burger.urdf\n'),
  'GET /catalog/robots/burger/urdf': new Response('<robot/>'),
};
const store = () => useProjectStore.getState();
const paths = () =>
  Object.keys(store().files)
    .filter((path) => path !== 'project.json')
    .sort();
let navigator: ReturnType<typeof watchNavigation>;

function open(answers = {}, texts: Record<string, string> = {}) {
  const server = fakeServer(answers);
  openProject({ texts: { 'project.json': '{}', ...texts } });
  store().setSettings({ universe: 'maze' });
  navigator = watchNavigation();
  show(<div />);
  return server;
}

beforeEach(() => useUniverseChoice.setState({ universe: null, robot: null }));

describe('a copy of your own', () => {
  it('of the universe is used and opened, and all of it is undone', async () => {
    open(ANSWERS);
    useUniverseChoice.setState({ universe: 'line' });
    await act(() => makeOwnCopy('universe'));
    expect(store().currentText('universes/my_maze.yaml')).toContain('name: "My maze"');
    expect(store().settings?.universe).toBe('my_maze');
    expect(useUniverseChoice.getState().universe).toBeNull();
    expect(navigator.openFile).toHaveBeenCalledExactlyOnceWith('universes/my_maze.yaml', undefined);
    expect(await screen.findByText('my_maze is now in the project, which runs with it.')).toBeInTheDocument();
    await user.click(screen.getByRole('button', { name: 'Undo' }));
    expect(store().settings?.universe).toBe('maze');
    expect(paths()).toEqual([]);
  });

  it('of the robot that the universe places comes with its files', async () => {
    open(ANSWERS, { 'robots/my_burger/robot.yaml': '' });
    await act(() => makeOwnCopy('robot'));
    expect(store().settings?.robot).toBe('my_burger_2');
    expect(paths()).toEqual([
      'robots/my_burger/robot.yaml',
      'robots/my_burger_2/burger.urdf',
      'robots/my_burger_2/robot.yaml',
    ]);
    await user.click(await screen.findByRole('button', { name: 'Undo' }));
    expect(store().settings?.robot).toBeUndefined();
    expect(paths()).toEqual(['robots/my_burger/robot.yaml']);
  });

  it('says why it could not be made, and may be tried again', async () => {
    open();
    await act(() => makeOwnCopy('universe'));
    expect(await screen.findByText(/The copy could not be made: /)).toBeInTheDocument();
    expect(store().settings?.universe).toBe('maze');
    expect(useCopying.getState().kind).toBeNull();
  });

  it('is made once at a time, and says so meanwhile', async () => {
    open(ANSWERS);
    let first!: Promise<void>;
    act(() => {
      first = makeOwnCopy('universe');
    });
    expect(useCopying.getState().kind).toBe('universe');
    expect(await screen.findByText('Copying the world into the project…')).toBeInTheDocument();
    await act(async () => {
      await makeOwnCopy('universe');
      await first;
    });
    expect(paths()).toEqual(['universes/my_maze.yaml']);
    await waitFor(() => expect(screen.queryByText('Copying the world into the project…')).toBeNull());
  });

  it('is for what is built in, in a project that may be changed', () => {
    open();
    const used = { kind: 'universe', id: 'maze', path: null, isOfUniverse: false } as const;
    expect(canCopy(used)).toBe(true);
    expect(canCopy({ ...used, path: 'universes/maze.yaml' })).toBe(false);
    expect(canCopy({ ...used, id: 'none' })).toBe(false);
    act(() => useProjectStore.setState({ role: 'viewer' }));
    expect(canCopy(used)).toBe(false);
  });
});
