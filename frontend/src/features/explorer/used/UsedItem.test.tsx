import { fireEvent, screen } from '@testing-library/react';
import { beforeEach, describe, expect, it, vi } from 'vitest';
import { useUniverseChooser } from '@/store/dialogs/universeChooser';
import { useProjectStore } from '@/store/project';
import { fakeServer, openProject, show, user, watchNavigation } from '../../../../harness/testing';
import type { InUse } from './inUse';
import { UsedItem } from './UsedItem';

const ANSWERS = { 'GET /catalog/universes/maze/text': new Response('name: Maze\nrobots: []\n') };
const maze: InUse = { kind: 'universe', id: 'maze', path: null, isOfUniverse: false };
let navigator: ReturnType<typeof watchNavigation>;

beforeEach(() => {
  fakeServer(ANSWERS);
  openProject({
    texts: { 'universes/hall.yaml': 'name: Great hall' },
  });
  useProjectStore.getState().setSettings({ universe: 'maze' });
  navigator = watchNavigation();
  useUniverseChooser.setState({ isOpen: false, first: 'universe' });
});

const menu = async (name: string) => {
  fireEvent.contextMenu(screen.getByTestId(name));
  await screen.findAllByRole('menuitem');
  return screen.getAllByRole('menuitem').map(({ textContent }) => textContent);
};

describe('what the project runs with', () => {
  it('is changed and copied where it is built in', async () => {
    show(<UsedItem used={maze} />);
    expect(screen.getByTestId('used-universe')).toHaveTextContent('MazeBuilt in');
    await user.click(screen.getByTestId('used-universe'));
    expect(useUniverseChooser.getState()).toEqual({ isOpen: true, first: 'universe' });
    expect(screen.getByRole('button', { name: 'Make my own copy of Maze' })).toBeInTheDocument();
    expect(await menu('used-universe')).toEqual(['Change the world…', 'Make my own copy']);
  });

  it("is opened where it is the project's own", async () => {
    show(<UsedItem used={{ ...maze, id: 'hall', path: 'universes/hall.yaml' }} />);
    expect(screen.getByTestId('used-universe')).toHaveTextContent('Great hallOf this project');
    expect(screen.queryByTestId('copy-universe')).toBeNull();
    await user.click(screen.getByTestId('used-universe'));
    expect(navigator.openFile).toHaveBeenCalledExactlyOnceWith('universes/hall.yaml', undefined);
    expect(await menu('used-universe')).toEqual(['Open', 'Change the world…']);
  });

  it('is a robot, which has cards of its own', async () => {
    show(<UsedItem used={{ kind: 'robot', id: 'turtle2', path: null, isOfUniverse: true }} />);
    expect(screen.getByTestId('used-robot')).toHaveTextContent('Built in, placed by the world');
    await user.click(screen.getByTestId('change-robot'));
    expect(useUniverseChooser.getState()).toEqual({ isOpen: true, first: 'robot' });
  });

  it('is no world', () => {
    show(<UsedItem used={{ ...maze, id: 'none' }} />);
    expect(screen.getByTestId('used-universe')).toHaveTextContent('No simulated world');
    expect(screen.queryByTestId('copy-universe')).toBeNull();
  });

  it('is copied from its menu', async () => {
    show(<UsedItem used={maze} />);
    await menu('used-universe');
    await user.click(screen.getByRole('menuitem', { name: 'Make my own copy' }));
    await vi.waitFor(() => expect(navigator.openFile).toHaveBeenCalledOnce());
  });
});
