import { act, screen, within } from '@testing-library/react';
import { expect, it } from 'vitest';
import '@/i18n/editorTexts';
import { useDebugMarks } from '@/store/debug/marks';
import { useSessionStore } from '@/store/session/store';
import { debugged, hold, treeNode, withTreeToHold } from '../../../harness/heldTree';
import { attached } from '../../../harness/attached';
import { openSession, show, user } from '../../../harness/testing';
import { ForceFields } from './ForceFields';

withTreeToHold();

const holdBelow = (type: string) =>
  act(() => useSessionStore.setState({ tree: [{ ...treeNode(1, 'r'), type }, treeNode(2, 'a')] }));

it('skips to a block only below sequences and fallbacks, and says why not elsewhere', async () => {
  await openSession();
  hold('driver');
  holdBelow('Parallel');
  show(<ForceFields tree="Main" node="a" />);
  expect(screen.getByRole('button', { name: 'Skip to here' })).toBeDisabled();
  expect(screen.getByText(/^Parallel does not pass over skipped children/)).toBeInTheDocument();
  for (const type of ['Fallback', 'ReactiveSequence']) {
    holdBelow(type);
    expect(screen.getByRole('button', { name: 'Skip to here' })).toBeEnabled();
    expect(screen.queryByText(/does not pass over/)).toBeNull();
  }
});

it('forces and releases results, steps to the block, skips to it and runs it alone', async () => {
  const executor = await openSession();
  hold('driver');
  holdBelow('SequenceStar');
  show(<ForceFields tree="Main" node="a" />);
  await user.selectOptions(screen.getByTestId('force-status'), 'FAILURE');
  await user.click(screen.getByRole('checkbox', { name: 'once' }));
  await user.click(screen.getByTestId('force'));
  await user.click(screen.getByRole('checkbox', { name: 'after its tick' }));
  await user.click(screen.getByTestId('force'));
  await user.click(screen.getByTestId('step-to'));
  await user.click(screen.getByRole('button', { name: 'Skip to here' }));
  await user.click(screen.getByRole('button', { name: 'Run alone' }));
  expect(screen.queryByTestId('release')).toBeNull();
  act(() =>
    useDebugMarks.setState({
      forced: new Map([['Main/a', { status: 'FAILURE', once: true, after: false, alone: false }]]),
    }),
  );
  expect(screen.getByTestId('forced-words')).toHaveTextContent('FAILURE is forced once');
  await user.click(screen.getByTestId('release'));
  expect(debugged(executor)).toMatchObject([
    { command: 'force', data: { uid: 2, effect: 'result', status: 'FAILURE', once: true } },
    { command: 'force', data: { uid: 2, status: 'FAILURE', once: true, after: true } },
    { command: 'step_to', data: { uid: 2, path: 'a' } },
    { command: 'force', data: { uid: 2, effect: 'skip_to' } },
    { command: 'force', data: { uid: 2, effect: 'alone' } },
    { command: 'release', data: { uid: 2 } },
  ]);
});

it('offers for another program only what its protocol has', async () => {
  await openSession();
  hold('driver');
  act(() => useSessionStore.setState({ attached: attached({ controls: true }) }));
  show(<ForceFields tree="Main" node="a" />);
  const results = within(screen.getByTestId('force-status')).getAllByRole('option');
  expect(results.map((each) => each.getAttribute('value'))).toEqual(['SUCCESS', 'FAILURE']);
  expect(screen.getAllByRole('button').map((each) => each.textContent)).toEqual(['Force']);
});
