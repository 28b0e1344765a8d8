import { act, screen } from '@testing-library/react';
import { beforeEach, describe, expect, it, onTestFinished } from 'vitest';
import { useLanguageStore, type LanguageState } from '@/store/language';
import { show, user } from '../../../harness/testing';
import { LanguageStatus } from './LanguageStatus';

const says = () => screen.getByRole('status').textContent;
const set = (state: LanguageState) => act(() => useLanguageStore.setState({ state }));
const failed = (reason: string, willRetry: boolean): LanguageState => ({ kind: 'failed', reason, willRetry });

beforeEach(() => {
  localStorage.clear();
  onTestFinished(() => {
    useLanguageStore.setState(useLanguageStore.getInitialState(), true);
    localStorage.clear();
  });
  show(<LanguageStatus path="actions/Go.py" />);
});

describe('LanguageStatus', () => {
  it.each([
    [{ kind: 'off' }, 'Python help is paused; it starts when you type'],
    [{ kind: 'starting' }, 'Python help is starting…'],
    [{ kind: 'ready' }, 'Python help is on'],
    [failed('No room.', false), 'No Python help: No room.'],
    [failed('No room.', true), 'No Python help: No room. It starts again by itself.'],
    [failed('', false), 'No Python help: The connection to the language server was lost.'],
  ] as const)('shows %j as %s', (state, words) => {
    set(state);
    expect(says()).toBe(words);
    expect(screen.getByTestId('language-state')).toHaveAttribute('data-state', state.kind);
  });

  it('offers to try again if that does not happen by itself', () => {
    const retry = () => screen.queryByRole('button', { name: 'Try again' });
    expect(retry()).toBeNull();
    set(failed('No room.', true));
    expect(retry()).toBeNull();
    set(failed('No room.', false));
    expect(retry()).not.toBeNull();
  });

  it('lets the user choose whether saving formats', async () => {
    const choice = screen.getByRole('checkbox', { name: 'Format when saving' });
    expect(choice).toBeChecked();
    await user.click(choice);
    expect(choice).not.toBeChecked();
    expect(localStorage.getItem('bts.formatOnSave')).toBe('off');
    await user.click(choice);
    expect(localStorage.getItem('bts.formatOnSave')).toBe('on');
  });
});
