import { beforeEach, describe, expect, it } from 'vitest';
import { useProjectStore } from '@/store/project';
import { followTreeRename, partsOf, shownPort, showValues, useShownValues } from './shown';

const speed = shownPort('Main', 'n2', 'speed');
const chosen = () => [...useShownValues.getState().ports];
const open = (projectId: string | null) => {
  useProjectStore.setState({ projectId });
};

beforeEach(() => {
  localStorage.clear();
  open(null);
  open('p1');
});

describe('the values that are shown', () => {
  it('are none at first', () => {
    expect(chosen()).toEqual([]);
  });

  it('are kept for each project', () => {
    showValues([speed, shownPort('Main', 'n3', 'goal')], true);
    open('p2');
    expect(chosen()).toEqual([]);
    open('p1');
    expect(chosen()).toEqual([speed, 'Main/n3/goal']);
    showValues([speed, 'Main/n3/goal'], false);
    expect(localStorage.getItem('bts.values.p1')).toBeNull();
  });

  it('are none where the store cannot be read', () => {
    localStorage.setItem('bts.values.p3', '{"a"');
    open('p3');
    expect(chosen()).toEqual([]);
    localStorage.setItem('bts.values.p4', '{"a": 1}');
    open('p4');
    expect(chosen()).toEqual([]);
  });

  it('follow a renamed tree', () => {
    showValues([speed, shownPort('Other', 'n2', 'speed')], true);
    followTreeRename('Main', 'Big/Tree');
    expect(chosen()).toEqual(['Big/Tree/n2/speed', 'Other/n2/speed']);
    expect(partsOf('Big/Tree/n2/speed')).toEqual({ tree: 'Big/Tree', node: 'n2', port: 'speed' });
  });
});
