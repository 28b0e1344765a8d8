import { act, screen, waitFor } from '@testing-library/react';
import { beforeEach, describe, expect, it } from 'vitest';
import { closeNewUniverse, openNewUniverse, useNewUniverse } from '@/store/dialogs/newUniverse';
import { useProjectStore } from '@/store/project';
import { write } from '../../../harness/documents';
import { fakeServer, openProject, show, user, watchNavigation } from '../../../harness/testing';
import { NewUniverse } from './NewUniverse';

const UNIVERSES = [
  { id: 'none', name: 'None', description: '' },
  { id: 'own_hall', name: 'Own hall', description: 'Wide.' },
  { id: 'own_room', name: 'Own room', description: 'Small.' },
];

function dialog(answers: Readonly<Record<string, unknown>> = {}) {
  const navigation = watchNavigation();
  fakeServer({
    'GET /catalog/universes': UNIVERSES,
    'GET /catalog/universes/own_room/text': new Response('name: Room\n'),
    ...answers,
  });
  openProject({ texts: { 'universes/Lab.yaml': '' } });
  show(<NewUniverse />);
  act(() => openNewUniverse('own_room'));
  return navigation;
}

const name = () => screen.findByTestId<HTMLInputElement>('new-universe-name');

beforeEach(() => closeNewUniverse());

describe('the dialogue for a new universe', () => {
  it('offers the built-in ones except for the outside world, the requested one first', async () => {
    dialog();
    await name();
    expect(screen.getAllByRole('radio').map((radio) => (radio as HTMLInputElement).value)).toEqual([
      'own_room',
      'own_hall',
    ]);
    expect(screen.getByRole('radio', { name: /Own room/ })).toBeChecked();
    expect(screen.getByText('Small.')).toBeInTheDocument();
  });

  it('copies it into the project, runs there, and opens it', async () => {
    const { openFile } = dialog();
    expect(await name()).toHaveValue('my_own_room');
    await user.click(screen.getByTestId('new-universe-ok'));
    await waitFor(() => expect(openFile).toHaveBeenCalledWith('universes/my_own_room.yaml', undefined));
    const project = useProjectStore.getState();
    expect(project.currentText('universes/my_own_room.yaml')).toBe('name: "My own room"\n');
    expect(project.settings?.universe).toBe('my_own_room');
    expect(useNewUniverse.getState().base).toBeNull();
  });

  it('does not change the setting of the project if it is not to be used', async () => {
    const { openFile } = dialog();
    await name();
    await user.click(screen.getByRole('switch', { name: 'Run this project there' }));
    await write(await name(), 'Second');
    await waitFor(() => expect(openFile).toHaveBeenCalledWith('universes/Second.yaml', undefined));
    expect(useProjectStore.getState().settings?.universe).toBeUndefined();
  });

  it.each(['lab', 'LAB', 'none'])('refuses the taken name %s', async (taken) => {
    const { openFile } = dialog();
    await write(await name(), taken);
    expect(screen.getByText('This project already has a world with this name')).toBeInTheDocument();
    expect(screen.getByTestId('new-universe-ok')).toBeDisabled();
    expect(openFile).not.toHaveBeenCalled();
  });

  it('reports why it could not be made, and stays open', async () => {
    dialog({ 'GET /catalog/universes/own_room/text': undefined });
    await name();
    await user.click(screen.getByTestId('new-universe-ok'));
    expect(await screen.findByRole('alert')).toHaveTextContent('Not found');
    expect(screen.getByTestId('new-universe-ok')).toBeEnabled();
    await user.click(screen.getAllByRole('button', { name: 'Cancel' }).at(-1)!);
    expect(useNewUniverse.getState().base).toBeNull();
  });
});
