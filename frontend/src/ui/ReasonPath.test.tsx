import { screen } from '@testing-library/react';
import { expect, it } from 'vitest';
import { useProjectStore } from '@/store/project';
import { openProject, show, user } from '../../harness/testing';
import { ReasonPath } from './ReasonPath';

const STEP = { tree: 'Main', node: 'r', label: 'all', results: ['SUCCESS', 'RUNNING'], role: '', what: '' };

it('leads to each block of the reason', async () => {
  openProject({
    trees: { Main: { r: { type: 'Sequence', children: [] } }, Dock: { d: { type: 'AlwaysSuccess' } } },
  });
  show(
    <ReasonPath
      path={[STEP, { tree: 'Dock', node: 'd', label: 'Go', results: [], role: 'commands', what: '/cmd_vel' }]}
    />,
  );
  expect(screen.getByRole('list', { name: 'Reason' })).toHaveTextContent(
    'all SUCCESS · RUNNINGGo commands /cmd_vel',
  );
  await user.click(screen.getByRole('button', { name: 'Go' }));
  expect(useProjectStore.getState().selection).toEqual(['d']);
});

it('is absent without a path', () => {
  show(<ReasonPath path={[]} />);
  expect(screen.queryByRole('list')).toBeNull();
});
