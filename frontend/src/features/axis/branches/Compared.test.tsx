import { act, screen, within } from '@testing-library/react';
import { afterEach, beforeEach, expect, it } from 'vitest';
import { endComparing, useComparing } from '@/store/moment/compare/comparing';
import { setEngineLink } from '@/store/moment/looking';
import { atPresent, useMoment } from '@/store/moment/store';
import { useProjectStore } from '@/store/project';
import type { Moment } from '@/store/recording/types';
import { initialSession } from '@/store/session/reduce';
import { useSessionStore } from '@/store/session/store';
import { openDiagram } from '../../../../harness/canvas';
import { segmentOf } from '../../../../harness/runs';
import { show, user } from '../../../../harness/testing';
import { Compared } from './Compared';

const row = { id: 'x', tree: 'Main', node: 'n1', path: 'drive', here: 'RUNNING', there: null } as const;

beforeEach(() => {
  setEngineLink(() => ({ post: () => undefined, onMessage: () => undefined }));
  useSessionStore.setState({
    segments: [
      segmentOf({ run: 'a', bytes: 0 }),
      segmentOf({ run: 'b', bytes: 0, run_number: 2 }),
      segmentOf({ run: 'c', bytes: 0, run_number: 3 }),
    ],
    branches: [
      { run: 'b', parent: 'a', from_t: 3, name: 'wider', is_gone: false },
      { run: 'c', parent: 'a', from_t: 4, name: '', is_gone: false },
    ],
  });
  useMoment.setState({ t: 6, shown: { t: 6 } as Moment });
  useComparing.setState({ other: 'b', partedAt: 3, otherEnd: 7, state: 'shown', rows: [row] });
});
afterEach(() => {
  act(() => endComparing());
  useMoment.setState(atPresent, true);
  useSessionStore.setState(initialSession, true);
});

it('lists the blocks that differ, and leads to them', async () => {
  openDiagram({ root: 'n1', nodes: { n1: { type: 'Sequence' } } });
  show(<Compared />);
  const panel = screen.getByTestId('axis-compared');
  expect(panel).toHaveTextContent('Compared at 6.00 s');
  expect(screen.getByTestId('compared-with')).toHaveDisplayValue('wider, from 3.0 s of run 1');
  const cells = within(screen.getByTestId('compared-row')).getAllByRole('cell');
  expect(cells.map(({ textContent }) => textContent)).toEqual(['drive', 'running', 'not there']);
  await user.click(within(panel).getByRole('button', { name: 'drive' }));
  expect(useProjectStore.getState().revealed?.node).toBe('n1');
  await user.click(within(panel).getByRole('button', { name: 'They part at 3.00 s' }));
  expect(useMoment.getState().t).toBe(3);
});

it.each([
  ['one', 'Until 3.00 s both are one run.'],
  ['beyond', 'The other run ends at 7.00 s.'],
  ['reading', 'Reading the recording…'],
] as const)('says why nothing is compared: %s', (state, words) => {
  useComparing.setState({ state, rows: [] });
  show(<Compared />);
  expect(screen.getByRole('status')).toHaveTextContent(words);
});

it('says that all is the same, or what went wrong', () => {
  useComparing.setState({ rows: [] });
  show(<Compared />);
  expect(screen.getByRole('status')).toHaveTextContent('All blocks have the same status');
  act(() => useComparing.setState({ failure: 'The part is damaged.' }));
  expect(screen.getByRole('status')).toHaveTextContent('The part is damaged.');
});

it('takes another run, and ends', async () => {
  show(<Compared />);
  await user.selectOptions(screen.getByTestId('compared-with'), 'Run 1');
  expect(useComparing.getState().other).toBe('a');
  await user.click(screen.getByTestId('compared-end'));
  expect(screen.queryByTestId('axis-compared')).toBeNull();
});
