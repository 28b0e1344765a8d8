import { act, screen, within } from '@testing-library/react';
import { afterEach, beforeEach, expect, it, vi, type MockInstance } from 'vitest';
import { show, user } from '../../../harness/testing';
import { outcomeOf, place } from '../../../harness/tries';
import * as connection from '@/store/session/connection';
import { useTryMany, type TriedBlock } from '@/store/moment/rerun/tryMany';
import { beginJob, changeJob, useTries } from '@/store/session/tries';
import { TryDialog } from './TryDialog';

const block: TriedBlock = {
  uid: 6,
  treeId: 'MainTree',
  nodeId: 'n6',
  path: 'Forward::6',
  ports: [
    { name: 'lin_speed', direction: 'input', type: 'double', default: null, required: true, description: '' },
  ],
  values: { lin_speed: '0.3' },
};
let send: MockInstance<typeof connection.send>;

beforeEach(() => {
  send = vi.spyOn(connection, 'send').mockResolvedValue(undefined);
});

afterEach(() => {
  useTries.setState({ job: null });
  useTryMany.setState({ asking: null });
});

const ask = (blocks = [block]) =>
  act(() => useTryMany.setState({ asking: { run: 'a', t: 3.25, blocks, uid: blocks[0]?.uid ?? null } }));

it('shows the values before they are tried, and refuses wrong ones', async () => {
  show(<TryDialog />);
  ask();
  expect(screen.getByTestId('tries-preview')).toHaveTextContent('0.15, 0.225, 0.3, 0.375, 0.45');
  await user.selectOptions(screen.getByTestId('tries-how'), 'list');
  expect(screen.getByTestId('tries-begin')).toBeDisabled();
  await user.type(screen.getByTestId('tries-list'), '1, fast');
  expect(screen.getByTestId('tries-preview')).toHaveTextContent('fast');
  expect(screen.getByTestId('tries-begin')).toBeDisabled();
  await user.clear(screen.getByTestId('tries-list'));
  await user.type(screen.getByTestId('tries-list'), '1, 2');
  await user.clear(screen.getByTestId('tries-duration'));
  expect(screen.getByTestId('tries-begin')).toBeDisabled();
  await user.type(screen.getByTestId('tries-duration'), '4');
  await user.click(screen.getByTestId('tries-begin'));
  expect(send).toHaveBeenCalledWith(
    'try_values',
    expect.objectContaining({ values: ['1', '2'], duration_s: 4 }),
  );
});

it('tries seeds in place of values', async () => {
  show(<TryDialog />);
  ask();
  await user.selectOptions(screen.getByTestId('tries-what'), 'seeds');
  expect(screen.queryByTestId('tries-block')).toBeNull();
  await user.click(screen.getByTestId('tries-begin'));
  expect(send).toHaveBeenCalledWith('try_seeds', expect.objectContaining({ seeds: [1, 2, 3, 4, 5] }));
});

it('says where no block has a port', () => {
  show(<TryDialog />);
  ask([]);
  expect(screen.getByRole('status')).toHaveTextContent('No block');
});

it('shows progress, outcomes, and how it ended', async () => {
  show(<TryDialog />);
  ask();
  act(() => beginJob('a1', place, ['1', '2']));
  expect(screen.getByTestId('tries-going')).toBeVisible();
  await user.click(screen.getByTestId('tries-stop'));
  expect(send).toHaveBeenCalledWith('stop_trying', { job: 'a1' });
  const crash = { t: 5, x: 1, y: 0, body: 'crate', robot: 'robot' };
  act(() =>
    changeJob('a1', () => ({
      started: {
        job: 'a1',
        t: 3.25,
        at_once: 1,
        outlines: [
          [
            [0, 0],
            [1, 0],
            [1, 1],
          ],
        ],
      },
      outcomes: [
        outcomeOf(0, { crash, collisions: 2 }),
        outcomeOf(1, { fingerprint: '0', as_before: true }),
        outcomeOf(2, { end: 'refused', message: 'Not a number.', ticks: 0 }),
      ],
      ended: { job: 'a1', end: 'failed', message: 'Its process was ended.' },
    })),
  );
  expect(screen.getByRole('alert')).toHaveTextContent('Its process was ended.');
  expect(screen.getByTestId('tries-row-0')).toHaveTextContent('5.00 s: crate, 1 more');
  expect(screen.getByTestId('tries-row-1')).toHaveTextContent('same as no. 0');
  expect(screen.getByTestId('tries-row-2')).toHaveTextContent('Not a number.');
  expect(within(screen.getByTestId('tries-row-2')).queryByRole('button')).toBeNull();
  expect(screen.getByTestId('tries-plan').querySelectorAll('polyline')).toHaveLength(3);
  await user.click(screen.getByTestId('tries-branch-1'));
  expect(send).toHaveBeenCalledWith('go_back', { run: 'a', t: 3.25 });
});
