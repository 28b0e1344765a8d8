import { screen } from '@testing-library/react';
import { beforeEach, describe, expect, it } from 'vitest';
import { openSettings, useSettingsDialog } from '@/store/dialogs/settings';
import { useProjectStore } from '@/store/project';
import { fakeServer, openProject, show, user } from '../../../harness/testing';
import { Settings } from './Settings';
import { SettingsForm } from './SettingsForm';

const settings = () => useProjectStore.getState().settings;
const name = () => screen.getByRole('textbox', { name: 'Name' });
const save = () => screen.getByRole('button', { name: 'Save' });

async function pick(label: string, option: string) {
  await user.click(screen.getByRole('combobox', { name: label }));
  await user.click(screen.getByText(option));
}

beforeEach(() => {
  const block = { d: { type: 'AlwaysSuccess' } };
  openProject({ trees: { Main: block, Dock: block } });
  openSettings();
});

describe('SettingsForm', () => {
  it('saves every field', async () => {
    show(<SettingsForm />);
    await user.clear(name());
    await user.type(name(), ' Patrol ');
    await user.click(screen.getByLabelText('Description'));
    await user.paste('Goes around.');
    await pick('Tree that Run starts', 'Dock');
    await pick('Ticks a second', '50 Hz');
    await user.click(screen.getByRole('radio', { name: 'Begin again' }));
    await user.click(screen.getByRole('radio', { name: 'Count it as a failure' }));
    await user.click(screen.getByRole('radio', { name: 'Exact (time waits for the tree)' }));
    await user.click(save());
    expect(settings()).toEqual({
      name: 'Patrol',
      description: 'Goes around.',
      main_tree: 'Dock',
      tick_hz: 50,
      on_finish: 'repeat',
      on_error: 'failure',
      time: 'exact',
    });
    expect(useSettingsDialog.getState().isOpen).toBe(false);
  });

  it('shows the defaults', () => {
    show(<SettingsForm />);
    expect(screen.getByRole('combobox', { name: 'Ticks a second' })).toHaveValue('20 Hz');
    expect(screen.getByRole('radio', { name: 'Stop' })).toBeChecked();
    expect(screen.getByRole('radio', { name: 'Stop the run' })).toBeChecked();
    expect(screen.getByRole('radio', { name: 'Live (as on a robot)' })).toBeChecked();
  });

  it('changes the distribution with its blocks, and says what that lacks', async () => {
    const id = useProjectStore.getState().projectId;
    const before = { name: 'Test', main_tree: 'Main' };
    useProjectStore.getState().addFile('project.json', JSON.stringify(before));
    const project = { ...before, ros_distro: 'humble' };
    fakeServer({
      [`POST /projects/${id}/changes`]: {
        revision: 2,
        files: [],
        actions: [],
        diagnostics: [],
        checked: true,
      },
      [`POST /projects/${id}/distribution`]: {
        files: [{ path: 'project.json', content: JSON.stringify(project) }],
        lacks: ['PersistentSequence'],
        kept: ['Wait'],
      },
    });
    show(<SettingsForm />);
    expect(screen.getByText(/The project states none: Jazzy has all its blocks/)).toBeVisible();
    await pick('ROS 2 distribution of the robot', 'Humble');
    await user.click(save());
    expect(
      await screen.findByText(
        'The project is for Humble now. Nav2 in Humble does not have: PersistentSequence. Your own code stays: Wait.',
      ),
    ).toBeVisible();
    expect(settings()?.ros_distro).toBe('humble');
    await user.click(screen.getByRole('button', { name: 'Undo' }));
    expect(settings()?.ros_distro).toBeUndefined();
  });

  it('says why the distribution stays', async () => {
    fakeServer({});
    show(<SettingsForm />);
    await pick('ROS 2 distribution of the robot', 'Humble');
    await user.click(save());
    expect(await screen.findByRole('combobox', { name: 'ROS 2 distribution of the robot' })).toBeInvalid();
    expect(useSettingsDialog.getState().isOpen).toBe(true);
  });

  it('keeps the changes of another user', async () => {
    show(<SettingsForm />);
    await user.click(screen.getByRole('radio', { name: 'Begin again' }));
    useProjectStore.getState().setSettings({ name: 'Theirs' });
    await user.click(save());
    expect(settings()).toMatchObject({ name: 'Theirs', on_finish: 'repeat' });
  });

  it.each([
    ['', 'A project needs a name: type at least one letter.'],
    ['x'.repeat(101), 'A name has at most 100 characters.'],
    ['a/b', 'A name is not a path: it contains no slash and is not only dots.'],
  ])('refuses the name “%s”', async (typed, message) => {
    show(<SettingsForm />);
    await user.clear(name());
    if (typed !== '') await user.paste(typed);
    await user.keyboard('{Enter}');
    expect(screen.getByText(message)).toBeInTheDocument();
    expect(save()).toBeDisabled();
    expect(settings()?.name).toBe('Test');
  });

  it('changes nothing when it is cancelled', async () => {
    show(<Settings />);
    await user.type(name(), '2');
    await user.click(screen.getByRole('button', { name: 'Cancel' }));
    expect(settings()?.name).toBe('Test');
    expect(useSettingsDialog.getState().isOpen).toBe(false);
  });

  it('is read only for a viewer', () => {
    useProjectStore.setState({ role: 'viewer' });
    show(<SettingsForm />);
    expect(name()).toBeDisabled();
    expect(save()).toBeDisabled();
    expect(screen.getByRole('radio', { name: 'Begin again' })).toBeDisabled();
  });
});
