import { screen } from '@testing-library/react';
import { describe, expect, it } from 'vitest';
import { useRenameKey } from '@/store/dialogs/renameKey';
import { openProject, show, user } from '../../../harness/testing';
import { BlackboardRow } from './BlackboardRow';

type Row = Parameters<typeof BlackboardRow>[0]['row'];

function open(more: Partial<Row>, canEdit = false) {
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
        <BlackboardRow row={shown} canEdit={canEdit} />
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
