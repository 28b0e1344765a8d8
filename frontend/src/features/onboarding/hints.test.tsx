import { MantineProvider } from '@mantine/core';
import { render, screen } from '@testing-library/react';
import userEvent from '@testing-library/user-event';
import { beforeEach, expect, it, vi } from 'vitest';
import '@/i18n';
import { useProjectStore } from '@/store/project';
import { Hint } from './Hint';
import { useHints } from './hints';

beforeEach(() => {
  localStorage.removeItem('bts.hints');
  useHints.setState({ done: [] });
  useProjectStore.getState().close();
});

const show = () =>
  render(
    <MantineProvider>
      <Hint />
    </MantineProvider>,
  );

it('shows three hints, one after the other, and none of them again', async () => {
  const user = userEvent.setup();
  show();
  const seen: (string | undefined)[] = [];
  for (let count = 0; count < 3; count += 1) {
    seen.push(screen.getByTestId('hint').dataset['hint']);
    await user.click(screen.getByRole('button', { name: 'Close this hint permanently' }));
  }
  expect(seen).toEqual(['build', 'run', 'find']);
  expect(screen.queryByTestId('hint')).toBeNull();
  // This simulates a reload.
  vi.resetModules();
  const { useHints: reloaded } = await import('./hints');
  expect(reloaded.getState().done).toEqual(seen);
});

it('skips a hint when the user has already followed it', () => {
  const { addTree, setActiveTree, apply } = useProjectStore.getState();
  addTree('Dock');
  setActiveTree('Dock');
  apply('Dock', 'add', [
    (draft) => {
      draft.nodes['a'] = { type: 'AlwaysSuccess' };
      draft.root = 'a';
    },
  ]);
  show();
  expect(screen.getByTestId('hint')).toHaveAttribute('data-hint', 'run');
});
