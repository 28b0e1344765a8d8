import { act, screen, waitFor, within } from '@testing-library/react';
import { beforeEach, describe, expect, it, onTestFinished } from 'vitest';
import { registerCommands, type UserCommand } from '@/commands/registry';
import { openShortcuts, useShortcutsDialog } from '@/store/dialogs/shortcuts';
import { show, user } from '../../../harness/testing';
import { Shortcuts } from './Shortcuts';

const command = (id: string, more: Partial<UserCommand>): UserCommand => ({
  id,
  group: 'edit',
  labelKey: 'canvas:command.undo',
  run: () => undefined,
  ...more,
});
const titles = () => screen.getAllByRole('heading', { level: 3 }).map(({ textContent }) => textContent);
const rows = (section: string) =>
  within(screen.getByRole('region', { name: section }))
    .getAllByRole('row')
    .map((row) =>
      within(row)
        .getAllByRole('cell')
        .map(({ textContent }) => textContent),
    );

beforeEach(() => {
  const end = registerCommands([
    command('a', { shortcut: '$mod+KeyZ' }),
    command('b', { labelKey: 'canvas:command.redo', keys: 'Delete' }),
    command('c', { labelKey: 'canvas:command.find' }),
    command('d', { group: 'run', labelKey: 'canvas:command.open', shortcut: 'F5' }),
    command('e', { group: 'view', labelKey: 'canvas:command.fold' }),
  ]);
  onTestFinished(() => {
    end();
    useShortcutsDialog.setState({ isOpen: false });
  });
  show(<Shortcuts />);
});

describe('Shortcuts', () => {
  it('is closed at first', () => {
    expect(screen.queryByTestId('shortcuts')).toBeNull();
    act(openShortcuts);
    expect(screen.getByRole('dialog', { name: 'Keyboard shortcuts' })).toBeInTheDocument();
  });

  it('has the commands with keys, in groups', () => {
    act(openShortcuts);
    expect(titles()).toEqual(['Run', 'Edit', 'On the canvas']);
    expect(rows('Edit')).toEqual([
      ['Undo', 'Ctrl+Z'],
      ['Redo', 'Del'],
    ]);
    expect(rows('Run')).toEqual([["Open the block's code or tree", 'F5']]);
  });

  it('has the keys of the canvas', () => {
    act(openShortcuts);
    expect(rows('On the canvas')).toEqual([
      ['Walk the tree', '← ↑ → ↓'],
      ['Move the block', 'Ctrl+← ↑ → ↓'],
      ['Remove, keep the children', 'Shift+Del'],
      ['Go to the top', 'Home'],
      ['Menu of the selected block', 'Shift+F10'],
    ]);
  });

  it('closes', async () => {
    act(openShortcuts);
    await user.click(screen.getByRole('button', { name: 'Close' }));
    await waitFor(() => expect(screen.queryByTestId('shortcuts')).toBeNull());
    expect(useShortcutsDialog.getState().isOpen).toBe(false);
  });
});
