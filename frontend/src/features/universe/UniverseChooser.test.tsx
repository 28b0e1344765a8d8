import { screen, waitFor } from '@testing-library/react';
import { describe, expect, it, onTestFinished } from 'vitest';
import { useNewRobot } from '@/store/dialogs/newRobot';
import { openUniverseChooser, useUniverseChooser } from '@/store/dialogs/universeChooser';
import { useProjectStore } from '@/store/project';
import { useUniverseChoice } from '@/store/run/universeChoice';
import { fakeServer, openProject, show, user, watchNavigation } from '../../../harness/testing';
import { UniverseChooser } from './UniverseChooser';

const UNIVERSES = [
  { id: 'own_room', name: 'Own room', description: 'Small.' },
  { id: 'lab', name: 'Their lab', description: '' },
  { id: 'none', name: 'None', description: '' },
];
const ROBOTS = [
  { id: 'own_rover', name: 'Own rover', description: 'Six wheels.' },
  { id: 'mine', name: 'Theirs', description: '' },
];

async function chooser(
  settings: { universe?: string; robot?: string } = { universe: 'own_room' },
  once: Partial<ReturnType<typeof useUniverseChoice.getState>> = {},
) {
  fakeServer({ 'GET /catalog/universes': UNIVERSES, 'GET /catalog/robots': ROBOTS });
  openProject({ texts: { 'universes/lab.yaml': '', 'robots/mine/robot.yaml': '' } });
  useProjectStore.getState().setSettings(settings);
  useUniverseChoice.setState(once);
  openUniverseChooser();
  onTestFinished(() => {
    useUniverseChoice.setState(useUniverseChoice.getInitialState(), true);
    useNewRobot.setState({ base: null });
  });
  show(<UniverseChooser />);
  await screen.findByTestId('worlds');
}

const values = (group: string) =>
  [...screen.getByRole('radiogroup', { name: group }).querySelectorAll('input')].map(({ value }) => value);
const choice = (id: string) => screen.getByTestId(`choice-${id}`);
const radio = (id: string) => choice(id).querySelector('input');
const settings = () => useProjectStore.getState().settings;
const use = () => user.click(screen.getByTestId('choose-world'));

describe('the chooser of universe and robot', () => {
  it('offers those of the project first, each id once', async () => {
    await chooser();
    expect(values('World')).toEqual(['lab', 'own_room', 'none']);
    expect(choice('lab')).toHaveTextContent('labMade in this project');
    expect(values('Robot')).toEqual(['', 'mine', 'own_rover']);
    expect(choice('mine')).toHaveTextContent('mineA robot of this project.');
    expect(radio('own_room')).toBeChecked();
    expect(radio('default')).toBeChecked();
    await waitFor(() => expect(radio('own_room')).toHaveFocus());
  });

  it('shows that it is loading', () => {
    fakeServer({});
    openProject({});
    show(<UniverseChooser />);
    expect(screen.getByLabelText('Loading worlds and robots')).toBeInTheDocument();
    expect(screen.queryByTestId('worlds')).toBeNull();
  });

  it('writes the choice into the project', async () => {
    await chooser();
    await user.click(choice('lab'));
    await user.click(choice('own_rover'));
    await use();
    expect(settings()).toMatchObject({ universe: 'lab', robot: 'own_rover' });
    expect(useUniverseChoice.getState()).toEqual({ universe: null, robot: null, seed: 0 });
    expect(useUniverseChooser.getState().isOpen).toBe(false);
  });

  it("returns to the universe's own robot", async () => {
    await chooser({ universe: 'own_room', robot: 'own_rover' });
    expect(radio('own_rover')).toBeChecked();
    await user.click(choice('default'));
    await use();
    expect(settings()?.robot).toBeUndefined();
  });

  it('does not store a choice for one session in the project', async () => {
    await chooser();
    expect(screen.getByRole('radio', { name: 'For this project' })).toBeChecked();
    await user.click(screen.getByRole('radio', { name: 'Only while this page is open' }));
    await user.click(choice('lab'));
    const seed = screen.getByTestId('seed');
    await user.clear(seed);
    await user.type(seed, '42');
    await use();
    expect(useUniverseChoice.getState()).toEqual({ universe: 'lab', robot: null, seed: 42 });
    expect(settings()?.universe).toBe('own_room');
  });

  it('starts with the choice for one session, and ends it', async () => {
    await chooser({ universe: 'own_room', robot: 'mine' }, { universe: 'lab', robot: 'own_rover', seed: 7 });
    expect(screen.getByRole('radio', { name: 'Only while this page is open' })).toBeChecked();
    expect(radio('lab')).toBeChecked();
    expect(radio('own_rover')).toBeChecked();
    expect(screen.getByTestId('seed')).toHaveValue('7');
    await user.click(screen.getByRole('radio', { name: 'For this project' }));
    await use();
    expect(useUniverseChoice.getState()).toEqual({ universe: null, robot: null, seed: 7 });
    expect(settings()).toMatchObject({ universe: 'lab', robot: 'own_rover' });
  });

  it('takes an empty seed as 0', async () => {
    await chooser(undefined, { seed: 7 });
    await user.clear(screen.getByTestId('seed'));
    await use();
    expect(useUniverseChoice.getState().seed).toBe(0);
  });

  it('needs a universe', async () => {
    await chooser({});
    expect(screen.getByTestId('choose-world')).toBeDisabled();
    await user.click(choice('lab'));
    expect(screen.getByTestId('choose-world')).toBeEnabled();
  });

  it('explains that there is no world outside, and offers neither robot nor seed', async () => {
    await chooser();
    expect(screen.queryByTestId('outside')).toBeNull();
    await user.click(choice('none'));
    expect(screen.getByTestId('outside')).toHaveTextContent('The program joins the ROS graph');
    expect(screen.queryByRole('radiogroup', { name: 'Robot' })).toBeNull();
    expect(screen.getByTestId('seed')).toBeDisabled();
    await use();
    expect(settings()?.universe).toBe('none');
  });

  it('opens a robot of the project in its editor', async () => {
    await chooser();
    const { openFile } = watchNavigation();
    expect(screen.queryByTestId('change-robot')).toBeNull();
    await user.click(choice('mine'));
    expect(screen.getByTestId('change-robot')).toHaveTextContent('Change it');
    await user.click(screen.getByTestId('change-robot'));
    expect(openFile).toHaveBeenCalledExactlyOnceWith('robots/mine/robot.yaml', undefined);
    expect(useUniverseChooser.getState().isOpen).toBe(false);
    expect(useNewRobot.getState().base).toBeNull();
  });

  it('offers a copy of a built-in robot', async () => {
    await chooser();
    const { openFile } = watchNavigation();
    await user.click(choice('own_rover'));
    expect(screen.getByTestId('change-robot')).toHaveTextContent('Change a copy');
    await user.click(screen.getByTestId('change-robot'));
    expect(useNewRobot.getState().base).toBe('own_rover');
    expect(openFile).not.toHaveBeenCalled();
  });
});
