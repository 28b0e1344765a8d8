import { beforeEach, describe, expect, it } from 'vitest';
import { setName, setPort } from '@/model/edits';
import { useProjectStore } from '@/store/project';
import { openProject } from '../../../../harness/testing';
import { hasAddedBlock, hasFilled, needOf } from './progress';

const state = () => useProjectStore.getState();

function during(act: () => void) {
  const before = state();
  act();
  const now = state();
  return { added: hasAddedBlock(now, before), filled: hasFilled(now, before) };
}

const addBlock = () =>
  state().apply('Main', 'add', [
    (draft) => {
      draft.nodes['n'] = { type: 'AlwaysSuccess' };
      draft.drafts.push('n');
    },
  ]);

beforeEach(() => {
  openProject({
    trees: { Main: { r: { type: 'Sequence', children: ['s'] }, s: { type: 'Sleep' } } },
    selected: ['r'],
  });
});

describe('a block was added', () => {
  it('by an edit', () => {
    expect(during(addBlock)).toEqual({ added: true, filled: true });
  });

  it('not by another edit, an undo or another project', () => {
    expect(during(() => state().apply('Main', 'rename', [setName('r', 'Go')])).added).toBe(false);
    addBlock();
    expect(during(() => state().undo()).added).toBe(false);
    const opens = () =>
      openProject({ trees: { Main: { a: { type: 'Sequence', children: ['b'] }, b: { type: 'Sleep' } } } });
    expect(during(opens).added).toBe(false);
  });
});

describe('a block was filled', () => {
  it('by a port, also where it merges with the edit before', () => {
    const type = (text: string) => () =>
      state().apply('Main', 'port', [setPort('s', 'msec', text)], { mergeKey: 'port s msec' });
    expect(during(type('5')).filled).toBe(true);
    expect(during(type('50')).filled).toBe(true);
  });

  it('by a child only if it has no ports', () => {
    expect(needOf(state())).toBe('child');
    expect(during(addBlock).filled).toBe(true);
    state().select('Main', ['s']);
    expect(needOf(state())).toBe('port');
    expect(during(() => state().undo()).filled).toBe(false);
    state().select('Main', ['s']);
    expect(during(addBlock).filled).toBe(false);
  });
});
