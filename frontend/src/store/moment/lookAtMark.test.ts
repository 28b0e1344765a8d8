import { beforeEach, expect, it, vi } from 'vitest';
import type { Moment, RecordedNode } from '@/store/recording/types';
import { lookAtMark } from './lookAtMark';
import { lookAt } from './looking';
import { usePastTree } from './pastTree';
import { atPresent, useMoment } from './store';

vi.mock('./looking', () => ({ lookAt: vi.fn((t: number) => useMoment.setState({ t })) }));

const tree = [{ uid: 2, tree_id: 'Main', node_id: 'n2' }] as RecordedNode[];
const arrives = (t: number) => useMoment.setState({ shown: { t } as Moment, tree });

beforeEach(() => {
  useMoment.setState(atPresent, true);
  vi.mocked(lookAt).mockClear();
  usePastTree.setState({ tree: null, node: null });
});

it('goes to the tick of a hold, and selects its block once the moment is there', () => {
  lookAtMark({ kind: 'held', t: 3, text: '', uid: 2, tick: 61 });
  expect(lookAt).toHaveBeenCalledWith(3, 61);
  useMoment.setState({ isPlaying: false });
  expect(usePastTree.getState().node).toBeNull();
  arrives(3);
  expect(usePastTree.getState()).toMatchObject({ tree: 'Main', node: 'n2' });
});

it('selects nothing when the user looks elsewhere, or for a mark of no block', () => {
  lookAtMark({ kind: 'held', t: 3, text: '', uid: 2 });
  useMoment.setState({ t: 5 });
  arrives(3);
  expect(usePastTree.getState().node).toBeNull();
  lookAtMark({ kind: 'collision', t: 4, text: '' });
  arrives(4);
  expect(lookAt).toHaveBeenLastCalledWith(4, null);
  expect(usePastTree.getState().node).toBeNull();
});
