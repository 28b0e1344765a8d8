import { Modal } from '@mantine/core';
import { act, screen } from '@testing-library/react';
import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { closePalette, openPalette } from '@/commands/palette';
import { registerCommands } from '@/commands/registry';
import { openProject, show, user } from '../../harness/testing';
import { CommandPalette } from './CommandPalette';

const first = vi.fn();
const second = vi.fn();
const never = vi.fn();
let stop = () => {};

beforeEach(() => {
  openProject({});
  stop = registerCommands([
    { id: 'test.xml', group: 'view', labelKey: 'frame:panel.xml', run: second },
    { id: 'test.timeline', group: 'run', labelKey: 'frame:panel.timeline', shortcut: 'F6', run: first },
    { id: 'test.topics', group: 'go', labelKey: 'frame:panel.topics', enabled: () => false, run: never },
    { id: 'test.hidden', group: 'go', labelKey: 'frame:panel.console', hidden: true, run: never },
  ]);
  show(
    <>
      <button>Before</button>
      <CommandPalette />
    </>,
  );
  screen.getByRole('button', { name: 'Before' }).focus();
  act(() => {
    openPalette();
  });
});
afterEach(() => {
  act(closePalette);
  stop();
  vi.clearAllMocks();
});

const labels = () => screen.getAllByRole('option').map((option) => option.textContent);
const selected = () => screen.getByRole('option', { selected: true });

describe('the command palette', () => {
  it('lists the commands by group, with their keys, without the hidden ones', () => {
    expect(labels()).toEqual(['TimelineF6', 'XML', 'Topics']);
    expect(screen.getByRole('option', { name: 'Topics' })).toHaveAttribute('aria-disabled', 'true');
  });

  it('is closed by Escape alone, and not with a dialogue below it', async () => {
    const closeBelow = vi.fn();
    show(
      <Modal opened onClose={closeBelow} trapFocus={false}>
        Below
      </Modal>,
    );
    await user.keyboard('{Escape}');
    expect(screen.queryByTestId('command-palette')).toBeNull();
    expect(closeBelow).not.toHaveBeenCalled();
  });

  it('is used by keys: the arrows go round, Enter runs the command after the focus has returned', async () => {
    const field = screen.getByRole('combobox');
    expect(field).toHaveFocus();
    await user.keyboard('{ArrowUp}{ArrowDown}{ArrowDown}');
    expect(selected()).toHaveTextContent('XML');
    expect(field).toHaveAttribute('aria-activedescendant', selected().id);
    await user.keyboard('{Enter}');
    expect(screen.queryByRole('dialog')).toBeNull();
    expect(screen.getByRole('button', { name: 'Before' })).toHaveFocus();
    await vi.waitFor(() => {
      expect(second).toHaveBeenCalledOnce();
    });
    expect(first).not.toHaveBeenCalled();
  });

  it('runs the command that is clicked', async () => {
    await user.click(screen.getByRole('option', { name: /Timeline/ }));
    await vi.waitFor(() => {
      expect(first).toHaveBeenCalledOnce();
    });
  });

  it('does not run a command that is not available, and stays open', async () => {
    await user.type(screen.getByRole('combobox'), 'top');
    expect(labels()).toEqual(['Topics']);
    await user.keyboard('{Enter}');
    expect(screen.getByRole('dialog')).toBeInTheDocument();
    expect(never).not.toHaveBeenCalled();
  });

  it('says that nothing has a name, and closes by Escape or a press beside it', async () => {
    await user.type(screen.getByRole('combobox'), 'qqq');
    expect(screen.getByText('No command or file has this name')).toBeInTheDocument();
    await user.keyboard('{Escape}');
    expect(screen.queryByTestId('command-palette')).toBeNull();
    act(() => {
      openPalette();
    });
    await user.click(screen.getByRole('dialog').parentElement!);
    expect(screen.queryByTestId('command-palette')).toBeNull();
  });
});
