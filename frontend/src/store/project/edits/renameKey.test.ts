import { describe, expect, it } from 'vitest';
import { planRename } from '@/model/keys/rename';
import { useProjectStore } from '@/store/project';
import { nodeOf, openProject } from '../../../../harness/testing';
import { renameKey } from './renameKey';

const sleep = { type: 'Sleep', ports: { msec: '{@k}' } };

function plan() {
  const state = useProjectStore.getState();
  return planRename(state, state.vocabulary, { board: '@', name: 'k' }, 'v');
}

const texts = () => ['Main', 'Other'].map((tree) => nodeOf(tree, 'r')?.ports?.['msec']);

describe('renameKey', () => {
  it('is one step for all trees', () => {
    openProject({ trees: { Main: { r: sleep }, Other: { r: sleep } } });
    expect(renameKey(plan())).not.toBeNull();
    expect(texts()).toEqual(['{@v}', '{@v}']);
    useProjectStore.getState().undo();
    expect(texts()).toEqual(['{@k}', '{@k}']);
  });

  it('is reverted by the returned function, unless there was another edit', () => {
    openProject({ trees: { Main: { r: sleep }, Other: { r: sleep } } });
    const undo = renameKey(plan());
    undo?.();
    expect(texts()).toEqual(['{@k}', '{@k}']);
    const late = renameKey(plan());
    useProjectStore.getState().addTree('More');
    late?.();
    expect(texts()).toEqual(['{@v}', '{@v}']);
  });

  it('is refused in a read-only project', () => {
    openProject({ trees: { Main: { r: sleep } } });
    useProjectStore.setState({ role: 'viewer' });
    expect(renameKey(plan())).toBeNull();
  });
});
