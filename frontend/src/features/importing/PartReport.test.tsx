import { screen } from '@testing-library/react';
import { expect, it, vi } from 'vitest';
import '@/i18n/editorTexts';
import { openProject, show, user } from '../../../harness/testing';
import { PartReport } from './PartReport';

it('says what came in, that nothing was left out, and offers to simplify', async () => {
  openProject({});
  const onSimplify = vi.fn();
  const onUndo = vi.fn();
  const part = {
    ...{ revision: 2, previous_revision: 1, path: 'universes/a.yaml', name: 'a', paths: [], removed: [] },
    ...{ report: { taken: [], assumed: [], left_out: [] }, test_drive: null, can_simplify: true, things: 1 },
  };
  show(<PartReport part={part} kind="universe" onOpen={vi.fn()} onUndo={onUndo} onSimplify={onSimplify} />);
  expect(screen.getByTestId('part-report')).toHaveTextContent('1 thing came in.Nothing was left out.');
  await user.click(screen.getByRole('button', { name: 'Simplify and import again' }));
  await user.click(screen.getByRole('button', { name: 'Undo the import' }));
  expect([onSimplify, onUndo].map(({ mock }) => mock.calls.length)).toEqual([1, 1]);
});

it('says what to look at where the server says that the drive does not fit', () => {
  openProject({});
  const part = {
    ...{ revision: 2, previous_revision: 1, path: 'robots/a/robot.yaml', name: 'a', paths: [], removed: [] },
    ...{ report: { taken: [], assumed: [], left_out: [] }, can_simplify: false, things: null },
    test_drive: { way_m: 1, aside_m: 0, turn_deg: 360, fits: false },
  };
  show(<PartReport part={part} kind="robot" onOpen={vi.fn()} onUndo={vi.fn()} onSimplify={vi.fn()} />);
  expect(screen.getByTestId('test-drive')).toHaveTextContent('Look at wheel radius');
});
