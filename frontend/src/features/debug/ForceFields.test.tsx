import { act, screen } from '@testing-library/react';
import { expect, it } from 'vitest';
import '@/i18n/editorTexts';
import { useDebugMarks } from '@/store/debug/marks';
import { debugged, hold, withTreeToHold } from '../../../harness/heldTree';
import { openSession, show, user } from '../../../harness/testing';
import { ForceFields } from './ForceFields';

withTreeToHold();

it('forces and releases results, steps to the block, skips to it and runs it alone', async () => {
  const executor = await openSession();
  hold('driver');
  show(<ForceFields tree="Main" node="a" />);
  await user.selectOptions(screen.getByTestId('force-status'), 'FAILURE');
  await user.click(screen.getByRole('checkbox', { name: 'once' }));
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
    { command: 'step_to', data: { uid: 2, path: 'a' } },
    { command: 'force', data: { uid: 2, effect: 'skip_to' } },
    { command: 'force', data: { uid: 2, effect: 'alone' } },
    { command: 'release', data: { uid: 2 } },
  ]);
});
