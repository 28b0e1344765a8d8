import { screen } from '@testing-library/react';
import { expect, it } from 'vitest';
import { agreesTo } from '@/store/run/apply';
import { show, user } from '../../../harness/testing';
import { ApplyDialog } from './ApplyDialog';

const nodes = (count: number) =>
  Array.from({ length: count }, (_, at) => ({ path: `Block ${at}`, node_id: `n${at}`, tree_id: 'Main' }));

it('shows which blocks are halted, and applies or not', async () => {
  show(<ApplyDialog />);
  const plan = { dry: true, kept: 2, renewed: [], added: [], removed: [], late_ports: [], halted: nodes(10) };
  const asked = agreesTo(plan);
  expect(await screen.findByText('Block 7')).toBeVisible();
  expect(screen.queryByText('Block 8')).toBeNull();
  expect(screen.getByText('and 2 more')).toBeVisible();
  expect(screen.getByText('2 blocks continue as they are.')).toBeVisible();
  await user.click(screen.getByTestId('apply-anyway'));
  expect(await asked).toBe(true);

  const on = agreesTo(plan, 'runOn');
  expect(await screen.findByText('Run on with the changed tree?')).toBeVisible();
  await user.click(screen.getByRole('button', { name: 'Run on' }));
  expect(await on).toBe(true);

  const late = [{ path: 'Sequence::2/Drive::3', node_id: 'd', tree_id: 'Main', port: 'speed' }];
  const again = agreesTo({ ...plan, halted: [], late_ports: late });
  expect(await screen.findByText('Sequence/Drive: speed')).toBeVisible();
  await user.keyboard('{Escape}');
  expect(await again).toBe(false);
});
