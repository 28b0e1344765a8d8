import { act, screen } from '@testing-library/react';
import { beforeEach, describe, expect, it, onTestFinished, vi } from 'vitest';
import { registerCommands } from '@/commands/registry';
import { openProject, show, user } from '../../../harness/testing';
import { searchHere } from '../../../harness/searchWorker';
import { SearchForm } from './SearchForm';
import { openSearch, useSearchStore } from './searchStore';

const onDown = vi.fn();

beforeEach(() => {
  searchHere();
  openProject({});
  onDown.mockClear();
});

const field = () => screen.getByTestId('search-text');

describe('SearchForm', () => {
  it('stores the text and the options', async () => {
    show(<SearchForm wrong={null} onReplaceAll={null} onDown={onDown} />);
    await user.type(field(), 'speed');
    const whole = screen.getByRole('button', { name: 'Whole words only' });
    await user.click(whole);
    expect(whole).toHaveAttribute('aria-pressed', 'true');
    expect(useSearchStore.getState()).toMatchObject({ text: 'speed', isWholeWord: true, isRegex: false });
  });

  it('moves to the hits by arrow and Enter', async () => {
    show(<SearchForm wrong={null} onReplaceAll={null} onDown={onDown} />);
    await user.type(field(), 'a{ArrowDown}{Enter}');
    expect(onDown).toHaveBeenCalledTimes(2);
  });

  it('shows an error at its field', () => {
    show(<SearchForm wrong="Not an expression" onReplaceAll={null} onDown={onDown} />);
    expect(field()).toBeInvalid();
    expect(field()).toHaveAccessibleDescription('Not an expression');
  });

  it('offers to replace all if something can be replaced', async () => {
    const onReplaceAll = vi.fn();
    show(<SearchForm wrong={null} onReplaceAll={onReplaceAll} onDown={onDown} />);
    const unfold = screen.getByRole('button', { name: 'Replace' });
    expect(unfold).toHaveAttribute('aria-expanded', 'false');
    await user.click(unfold);
    await user.type(screen.getByTestId('search-replacement'), 'v');
    await user.click(screen.getByRole('button', { name: 'Replace all' }));
    expect(onReplaceAll).toHaveBeenCalledOnce();
    expect(useSearchStore.getState().replacement).toBe('v');
  });

  it('gets the focus with its command, and returns it with Escape', async () => {
    const run = vi.fn();
    const row = { id: 'go.tree', group: 'go', labelKey: 'frame:command.goToTree', run } as const;
    onTestFinished(registerCommands([row]));
    show(<SearchForm wrong={null} onReplaceAll={null} onDown={onDown} />);
    act(() => openSearch());
    expect(field()).toHaveFocus();
    await user.keyboard('{Escape}');
    expect(run).toHaveBeenCalledOnce();
  });
});
