import { screen } from '@testing-library/react';
import { afterEach, beforeEach, expect, it } from 'vitest';
import { registerCommands } from '@/commands/registry';
import { noRange, useRange } from '@/store/moment/range';
import { initialSession } from '@/store/session/reduce';
import { useSessionStore } from '@/store/session/store';
import { segmentOf } from '../../../harness/runs';
import { show, user } from '../../../harness/testing';
import { AXIS_MENU, AxisMenu } from './AxisMenu';
import { markCommands } from './markCommands';
import { rangeCommands } from './rangeCommands';

let stop = () => {};

beforeEach(() => {
  stop = registerCommands([...markCommands, ...rangeCommands]);
  useSessionStore.setState({ segments: [segmentOf()] });
});
afterEach(() => {
  stop();
  useSessionStore.setState(initialSession, true);
  useRange.setState(noRange);
});

it('has all commands of the axis, with their keys, and does them', async () => {
  const all = [...markCommands, ...rangeCommands];
  expect([...AXIS_MENU.flat()].sort()).toEqual(
    [
      ...all.map(({ id }) => id),
      ...['time.goBack', 'time.runOn', 'time.tryMany', 'time.source', 'time.branch', 'time.compare'],
    ].sort(),
  );
  show(<AxisMenu />);
  await user.click(screen.getByRole('button', { name: 'Marks, range, changes and zoom' }));
  const loop = await screen.findByTestId('axis-time.loop');
  expect(loop).toBeDisabled();
  await user.click(screen.getByTestId('axis-time.markA'));
  expect(useRange.getState().a).toBe(100);
});

it('offers what can be done when it is opened, not when the axis was drawn', async () => {
  show(<AxisMenu />);
  useRange.setState({ a: 100 });
  await user.click(screen.getByRole('button', { name: 'Marks, range, changes and zoom' }));
  expect(await screen.findByTestId('axis-time.clearRange')).toBeEnabled();
  await user.click(screen.getByTestId('axis-time.clearRange'));
  expect(useRange.getState().a).toBeNull();
});
