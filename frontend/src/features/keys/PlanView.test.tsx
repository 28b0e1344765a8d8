import { screen, within } from '@testing-library/react';
import { expect, it } from 'vitest';
import { planRename } from '@/model/keys/rename';
import { useProjectStore } from '@/store/project';
import { openProject, show, user, watchNavigation } from '../../../harness/testing';
import { PlanView } from './PlanView';

it('shows the changes by tree, and the places that the user must check', async () => {
  openProject({
    trees: {
      Main: {
        r: { type: 'Sequence', children: ['a', 'b', 'c'] },
        a: { type: 'Sleep', name: 'wait', ports: { msec: '{k}' } },
        b: { type: 'SubTree', tree: 'In', ports: { _autoremap: 'true' } },
        c: { type: 'Script', ports: { code: 'k % 2' } },
      },
      In: { i: { type: 'Sleep', ports: { msec: '{@k}' } } },
    },
    texts: { 'actions/Go.py': "self.set('k', 1)\n" },
  });
  const { openFile } = watchNavigation();
  const { diagrams, mainTree, vocabulary } = useProjectStore.getState();
  const forest = { diagrams, mainTree };
  const plan = planRename(forest, vocabulary, { board: 'Main', name: 'k' }, 'v');
  show(<PlanView plan={plan} name="k" forest={forest} />);
  expect(screen.getByText(/The same entry in: Main, In.*@k.*_autoremap in: Main/)).toBeInTheDocument();
  expect(screen.getByRole('region', { name: 'Main' })).toHaveTextContent('wait · port msec{k} {v}');
  expect(screen.getByRole('region', { name: 'In' })).toHaveTextContent('{@k} {@v}');
  expect(screen.getByRole('region', { name: /Scripts with errors/ })).toHaveTextContent('k % 2');
  const look = within(screen.getByRole('region', { name: /Python is not changed/ }));
  await user.click(look.getByRole('button', { name: 'actions/Go.py:1' }));
  expect(openFile).toHaveBeenCalledWith('actions/Go.py', 1);
});
