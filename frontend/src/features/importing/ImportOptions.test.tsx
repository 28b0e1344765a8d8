import { screen, waitFor } from '@testing-library/react';
import { expect, it, vi } from 'vitest';
import '@/i18n/editorTexts';
import { write } from '../../../harness/documents';
import { openProject, show, user } from '../../../harness/testing';
import { ImportOptions } from './ImportOptions';

it('sends only the arguments that differ from their defaults', async () => {
  openProject({});
  const onTake = vi.fn();
  const given = ['radius', 'track'].map((name) => ({ name, default: '1' }));
  const item = { kind: 'robot', source: 'xacro', path: 'a.xacro', name: 'a', is_main: true } as const;
  const found = { items: [{ ...item, arguments: given }], left_out: [] };
  show(<ImportOptions found={found} kind={null} onTake={onTake} onRestart={vi.fn()} />);
  await waitFor(() => expect(screen.getByTestId('import-name')).toHaveFocus());
  await write(screen.getByLabelText('track'), '2');
  expect(onTake).toHaveBeenCalledExactlyOnceWith({
    ...{ kind: 'robot', main: 'a.xacro', name: 'a', args: { track: '2' } },
    ...{ use: true, replace: false, simplify: false },
  });
});

it('leaves the focus where the file is chosen', async () => {
  openProject({});
  const item = { kind: 'robot', source: 'xacro', is_main: true } as const;
  const items = ['a', 'b'].map((name) => ({ ...item, arguments: [], path: `${name}.xacro`, name }));
  show(<ImportOptions found={{ items, left_out: [] }} kind={null} onTake={vi.fn()} onRestart={vi.fn()} />);
  await waitFor(() => expect(screen.getByTestId('import-name')).toHaveFocus());
  await user.click(screen.getByRole('radio', { name: /b\.xacro/ }));
  expect(screen.getByTestId('import-name')).toHaveValue('b');
  // A timer that was set by the new form comes before this one.
  await new Promise((done) => setTimeout(done));
  expect(screen.getByRole('radio', { name: /b\.xacro/ })).toHaveFocus();
});
