import { screen } from '@testing-library/react';
import { describe, expect, it, vi } from 'vitest';
import { useRenameKey } from '@/store/dialogs/renameKey';
import * as looking from '@/store/moment/looking';
import { openProject, show, user } from '../../../harness/testing';
import { BlackboardRow } from './BlackboardRow';

type Row = Parameters<typeof BlackboardRow>[0]['row'];

function open(more: Partial<Row>, canEdit = false, isRecorded = false) {
  const row = {
    scope: '',
    key: 'goal',
    type: 'float',
    value: 0.123456789,
    preview: false,
    removed: false,
    changedAt: 1,
    ...more,
  };
  const table = (shown: Row) => (
    <table>
      <tbody>
        <BlackboardRow row={shown} canEdit={canEdit} isRecorded={isRecorded} />
      </tbody>
    </table>
  );
  show(table(row as Row));
  return screen.getByTestId('blackboard-goal');
}

describe('BlackboardRow', () => {
  it('shows the key, the value and the type, each in full in its tooltip', () => {
    const row = open({});
    expect([...row.children].map(({ textContent }) => textContent)).toEqual(['goal', '0.123457', 'float']);
    for (const title of ['goal', '0.123457', 'float']) expect(screen.getByTitle(title)).toBeInTheDocument();
    expect(screen.getByRole('rowheader')).toHaveAttribute('scope', 'row');
  });

  it('opens the dialogue that renames its key in the tree of its scope', async () => {
    openProject({ trees: { Main: { r: { type: 'SubTree', tree: 'In' } }, In: { i: { type: 'Sleep' } } } });
    open({ scope: 'In::1' });
    await user.click(screen.getByRole('button', { name: 'Rename the key goal everywhere…' }));
    expect(useRenameKey.getState()).toEqual({ isOpen: true, key: { board: 'In', name: 'goal' } });
  });

  it('goes to the moment of its last write', async () => {
    const look = vi.spyOn(looking, 'lookAt').mockReturnValue(undefined);
    open({ written: { t: 2.5, by: 'Aim' } }, false, true);
    await user.click(screen.getByRole('button', { name: 'since 2.50 s, written by Aim' }));
    expect(look).toHaveBeenCalledExactlyOnceWith(2.5);
  });

  it('shows its recorded writes, and hides them again', async () => {
    vi.spyOn(looking, 'followWrites').mockImplementation((_, show) => {
      show([{ t: 3.25, value: 7, isRemoved: false, by: 'Aim' }]);
      return () => undefined;
    });
    open({}, false, true);
    await user.click(screen.getByRole('button', { name: 'Show the writes of goal' }));
    expect(screen.getByRole('list', { name: /Writes of goal/ })).toHaveTextContent('3.25 s7Aim');
    await user.click(screen.getByRole('button', { name: 'Hide the writes of goal' }));
    expect(screen.queryByRole('list')).toBeNull();
  });

  it('offers no writes without a recording', () => {
    open({});
    expect(screen.queryByRole('button', { name: /writes/ })).toBeNull();
  });

  it('can be edited where that is allowed', () => {
    expect(open({}, true)).toContainElement(screen.getByRole('textbox', { name: 'Value of goal' }));
    expect(screen.queryByTitle('0.123457')).toBeNull();
  });

  it('cannot be edited elsewhere', () => {
    open({ value: [1, 2] });
    expect(screen.queryByRole('textbox')).toBeNull();
    expect(screen.getByTitle('[1,2]')).toBeInTheDocument();
  });
});
