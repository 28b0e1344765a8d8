import { act, screen } from '@testing-library/react';
import { beforeEach, expect, it, onTestFinished, vi } from 'vitest';
import type { TreeNode } from '@/generated/messages';
import { ofSession, useSource } from '@/store/moment/source';
import { atPresent, useMoment } from '@/store/moment/store';
import type { Moment } from '@/store/recording/types';
import { show } from '../../../harness/testing';
import { RecordedTree } from './RecordedTree';

const node = (uid: number, parent: number, name: string, type = name): TreeNode => ({
  ...{ uid, parent, name, type },
  ...{ kind: 'Action', path: name, node_id: '', tree_id: 'Main' },
});
const shown = {
  statuses: [[1, 'RUNNING']],
  flashes: [[2, 'FAILURE']],
  was: [],
  isHalted: false,
} as unknown as Moment;

beforeEach(() => {
  vi.spyOn(Element.prototype, 'clientHeight', 'get').mockReturnValue(300);
  vi.spyOn(Element.prototype, 'clientWidth', 'get').mockReturnValue(300);
  vi.spyOn(HTMLElement.prototype, 'offsetHeight', 'get').mockReturnValue(300);
  onTestFinished(() => {
    useMoment.setState(atPresent);
    useSource.setState(ofSession);
  });
});

it('lists the nodes of a foreign tree with what they did', () => {
  show(<RecordedTree />);
  expect(screen.queryByTestId('recorded-tree')).toBeNull();
  act(() => {
    useSource.setState({ kept: { id: 'r1', name: 'patrol.btlog' } });
    useMoment.setState({
      t: 1,
      shown,
      tree: [node(1, 0, 'patrol', 'Sequence'), node(2, 1, 'Way'), node(3, 1, 'Act')],
    });
  });
  expect(screen.getByText('The tree of this log: 3 nodes')).toBeInTheDocument();
  const rows = screen.getAllByRole('listitem');
  expect(rows.map((row) => row.textContent)).toEqual(['patrolSequencerunning', 'Wayfailure', 'Actidle']);
  expect(rows.map((row) => row.dataset['passed'])).toEqual([undefined, 'true', undefined]);
});
