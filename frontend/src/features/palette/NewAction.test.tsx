import { screen } from '@testing-library/react';
import { beforeEach, describe, expect, it, vi } from 'vitest';
import { useProjectStore } from '@/store/project';
import { action, openProject, show, user, watchNavigation } from '../../../harness/testing';
import { NewAction } from './NewAction';

const onDone = vi.fn();
const name = () => screen.getByRole('textbox', { name: 'Name of the action' });
const create = () => screen.getByRole('button', { name: 'Create' });
const textOf = (path: string) => useProjectStore.getState().currentText(path);

beforeEach(() => {
  onDone.mockReset();
  openProject({ trees: { Main: {} }, actions: [action('Grasp')] });
  show(<NewAction onDone={onDone} />);
});

describe('NewAction', () => {
  it('takes the focus, and explains the name', () => {
    expect(name()).toHaveFocus();
    expect(screen.getByText(/it names the class and the file/)).toBeInTheDocument();
    expect(create()).toBeDisabled();
    expect(screen.getByRole('radiogroup', { name: 'Kind' })).toBeInTheDocument();
    expect(screen.getByRole('radio', { name: 'Action' })).toBeChecked();
  });

  it('makes an action with Enter, and opens it', async () => {
    const { openFile } = watchNavigation();
    await user.type(name(), 'PickUp{Enter}');
    expect(textOf('actions/PickUp.py')).toContain('class PickUp');
    expect(textOf('actions/PickUp.py')).not.toContain('NODE_KIND');
    expect(openFile).toHaveBeenCalledExactlyOnceWith('actions/PickUp.py');
    expect(onDone).toHaveBeenCalledOnce();
  });

  it('makes a condition', async () => {
    await user.click(screen.getByRole('radio', { name: 'Condition' }));
    await user.type(name(), 'IsHome');
    await user.click(create());
    expect(textOf('actions/IsHome.py')).toContain('NODE_KIND = "Condition"');
  });

  it.each(['Grasp', 'Sequence'])('refuses the name %s, which is in use', async (taken) => {
    await user.type(name(), `${taken}{Enter}`);
    expect(screen.getByText('This name is already in use.')).toBeInTheDocument();
    expect(name()).toBeInvalid();
    expect(onDone).not.toHaveBeenCalled();
    await user.type(name(), '2');
    expect(screen.queryByText('This name is already in use.')).toBeNull();
    expect(create()).toBeEnabled();
  });

  it.each(['beep!', '2nd', 'lambda'])('says why there can be no class %s', async (typed) => {
    await user.type(name(), `${typed}{Enter}`);
    expect(screen.getByText(/no Python keyword/)).toBeInTheDocument();
    expect(name()).toBeInvalid();
    expect(onDone).not.toHaveBeenCalled();
  });

  it('makes nothing when it is cancelled', async () => {
    await user.type(name(), 'PickUp');
    await user.click(screen.getByRole('button', { name: 'Cancel' }));
    expect(onDone).toHaveBeenCalledOnce();
    expect(textOf('actions/PickUp.py')).toBeNull();
  });
});
