import { screen } from '@testing-library/react';
import { afterEach, beforeEach, expect, it } from 'vitest';
import { registerCommands } from '@/commands/registry';
import { noRange, useRange } from '@/store/moment/range';
import { initialSession } from '@/store/session/reduce';
import { useSessionStore } from '@/store/session/store';
import { segmentOf } from '../../../harness/runs';
import { show, user } from '../../../harness/testing';
import { AXIS_MENU, AxisMenu } from './AxisMenu';
import { rangeCommands } from './rangeCommands';

let stop = () => {};

beforeEach(() => {
  stop = registerCommands(rangeCommands);
  useSessionStore.setState({ segments: [segmentOf()] });
});
afterEach(() => {
  stop();
  useSessionStore.setState(initialSession, true);
  useRange.setState(noRange);
});

it('has all commands of the axis, with their keys, and does them', async () => {
  expect([...AXIS_MENU.flat()].sort()).toEqual(rangeCommands.map(({ id }) => id).sort());
  show(<AxisMenu />);
  await user.click(screen.getByRole('button', { name: 'Range, changes and zoom' }));
  const loop = await screen.findByTestId('axis-time.loop');
  expect(loop).toBeDisabled();
  await user.click(screen.getByTestId('axis-time.markA'));
  expect(useRange.getState().a).toBe(100);
});
