import { screen } from '@testing-library/react';
import { beforeEach, describe, expect, it, vi } from 'vitest';
import { useProjectStore } from '@/store/project';
import { nodeOf, openProject, show, user } from '../../../harness/testing';
import { RenameKeyForm } from './RenameKeyForm';

const onDone = vi.fn();

beforeEach(() => {
  onDone.mockClear();
  openProject({
    trees: {
      Main: {
        r: { type: 'Sequence', children: ['a', 'b'] },
        a: { type: 'Sleep', ports: { msec: '{k}' } },
        b: { type: 'SubTree', tree: 'In', ports: { k: '{=}' } },
      },
      In: { i: { type: 'Sleep', ports: { msec: '{k}' }, conditions: { _skipIf: 'other > 1' } } },
    },
  });
});

const newName = () => screen.getByTestId('rename-key-new');
const submit = () => screen.getByRole('button', { name: 'Rename' });

describe('RenameKeyForm', () => {
  it('renames the given key, and undoes that', async () => {
    show(<RenameKeyForm start={{ board: 'In', name: 'k' }} onDone={onDone} />);
    expect(newName()).toHaveValue('k');
    expect(submit()).toBeDisabled();
    await user.clear(newName());
    await user.type(newName(), 'pause_msec{Enter}');
    expect(onDone).toHaveBeenCalledOnce();
    expect(nodeOf('Main', 'a')?.ports).toEqual({ msec: '{pause_msec}' });
    expect(nodeOf('Main', 'b')?.ports).toEqual({ pause_msec: '{=}' });
    expect(nodeOf('In', 'i')?.ports).toEqual({ msec: '{pause_msec}' });
    expect(await screen.findByText('k is pause_msec now.')).toBeInTheDocument();
    await user.click(screen.getByRole('button', { name: 'Undo' }));
    expect(nodeOf('In', 'i')?.ports).toEqual({ msec: '{k}' });
  });

  it('reports why a name is invalid', async () => {
    show(<RenameKeyForm start={{ board: 'In', name: 'k' }} onDone={onDone} />);
    await user.clear(newName());
    await user.type(newName(), 'a b');
    expect(screen.getByText(/cannot be a key/)).toBeInTheDocument();
    await user.clear(newName());
    await user.type(newName(), 'other');
    expect(screen.getByText(/is a key there already/)).toBeInTheDocument();
    expect(submit()).toBeDisabled();
  });

  it('offers all keys of the project', async () => {
    show(<RenameKeyForm start={null} onDone={onDone} />);
    expect(newName()).toBeDisabled();
    await user.click(screen.getByTestId('rename-key-old'));
    const options = screen.getAllByRole('option', { hidden: true });
    expect(options.map(({ textContent }) => textContent)).toEqual(['k — Main', 'other — In']);
    await user.click(options[1]!);
    expect(newName()).toHaveValue('other');
  });

  it('changes nothing in a read-only project', () => {
    useProjectStore.setState({ role: 'viewer' });
    show(<RenameKeyForm start={{ board: 'In', name: 'k' }} onDone={onDone} />);
    expect(newName()).toBeDisabled();
    expect(screen.getByText('This project is read-only.')).toBeInTheDocument();
  });
});
