import { act, screen } from '@testing-library/react';
import { expect, it, onTestFinished, vi } from 'vitest';
import type { TreeNode } from '@/generated/messages';
import { atPresent, useMoment } from '@/store/moment/store';
import type { Moment } from '@/store/recording/types';
import { show } from '../../../harness/testing';
import { NodeList } from './NodeList';

const node = (uid: number, parent: number, name: string, type = name): TreeNode => ({
  ...{ uid, parent, name, type },
  ...{ kind: 'Action', path: name, node_id: '', tree_id: 'Main' },
});
const shown = {
  statuses: [[1, 'RUNNING']],
  flashes: [[2, 'FAILURE']],
  was: [],
  halted: null,
} as unknown as Moment;

it('lists the nodes that ran with what they did', () => {
  vi.spyOn(Element.prototype, 'clientHeight', 'get').mockReturnValue(300);
  vi.spyOn(Element.prototype, 'clientWidth', 'get').mockReturnValue(300);
  vi.spyOn(HTMLElement.prototype, 'offsetHeight', 'get').mockReturnValue(300);
  onTestFinished(() => useMoment.setState(atPresent));
  act(() => useMoment.setState({ t: 1, shown }));
  show(<NodeList tree={[node(1, 0, 'patrol', 'Sequence'), node(2, 1, 'Way'), node(3, 1, 'Act')]} />);
  const rows = screen.getAllByRole('listitem');
  expect(rows.map((row) => row.textContent)).toEqual(['patrolSequencerunning', 'Wayfailure', 'Actidle']);
  expect(rows.map((row) => row.dataset['passed'])).toEqual([undefined, 'true', undefined]);
});
