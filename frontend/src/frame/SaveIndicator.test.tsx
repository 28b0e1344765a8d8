import { act, screen } from '@testing-library/react';
import { afterEach, expect, it, vi } from 'vitest';
import * as autosave from '@/store/saving/autosave';
import { type SaveState, useSavingStore } from '@/store/saving/store';
import { useUnsaved } from '@/store/saving/useUnsaved';
import { show, user } from '../../harness/testing';
import { SaveIndicator } from './SaveIndicator';

afterEach(() => {
  useSavingStore.setState({ state: { kind: 'saved' } });
  vi.restoreAllMocks();
});

const cases: [SaveState, string, RegExp][] = [
  [{ kind: 'saved' }, 'Saved', /Every edit is on the server/],
  [{ kind: 'dirty' }, 'Not saved yet', /saved in a moment/],
  [{ kind: 'saving' }, 'Saving…', /on their way/],
  [{ kind: 'conflict', conflicts: [] }, 'Two versions', /choose what to keep/],
  [{ kind: 'failed', code: 'offline', reason: 'No network.' }, 'Offline: kept here', /cannot be reached/],
  [
    { kind: 'failed', code: 'disk_full', reason: 'The disk is full.' },
    'Kept in this browser: The disk is full.',
    /The disk is full\. — your edits are kept/,
  ],
];

it.each(cases)('shows %o in words, with the reason in its tip', async (state, text, tip) => {
  useSavingStore.setState({ state });
  show(<SaveIndicator />);
  const indicator = screen.getByTestId('save-state');
  expect(indicator).toHaveTextContent(text);
  expect(indicator).toHaveAttribute('data-state', state.kind);
  // Its colour is calm: nothing is lost, and nothing is to be done.
  expect(indicator.hasAttribute('data-offline')).toBe('code' in state && state.code === 'offline');
  await user.hover(indicator);
  expect(await screen.findByRole('tooltip')).toHaveTextContent(tip);
});

it('does not say “Saved” beside a text that is not in the project', () => {
  function Field({ isTyped }: { readonly isTyped: boolean }) {
    useUnsaved(isTyped);
    return null;
  }
  const page = (isTyped: boolean) => (
    <>
      <Field isTyped={isTyped} />
      <SaveIndicator />
    </>
  );
  const { rerender, unmount } = show(page(true));
  const indicator = () => screen.getByTestId('save-state');
  expect(indicator()).toHaveTextContent('Not saved yet');
  expect(indicator()).toHaveAttribute('data-state', 'typing');
  act(() => useSavingStore.setState({ state: { kind: 'saving' } }));
  expect(indicator()).toHaveTextContent('Saving…');
  act(() => useSavingStore.setState({ state: { kind: 'saved' } }));
  rerender(page(false));
  expect(indicator()).toHaveTextContent(/^Saved$/);
  rerender(page(true));
  unmount();
  expect(useSavingStore.getState().unsaved).toBe(0);
});

it('saves now when it is pressed; a failed save is already shown by its state', async () => {
  const save = vi.spyOn(autosave, 'saveNow').mockRejectedValue(new Error('offline'));
  show(<SaveIndicator />);
  await user.click(screen.getByTestId('save-state'));
  expect(save).toHaveBeenCalledOnce();
});
