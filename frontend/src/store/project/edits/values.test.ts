import { expect, it } from 'vitest';
import { useProjectStore } from '@/store/project';
import { oneBlock, projectDetail, projectFile } from '@/store/testing';
import { setValues } from './values';

const store = () => useProjectStore.getState();
const portOf = (tree: string) => store().diagrams[tree]?.nodes['n1']?.ports?.['speed'];

it('sets ports of several trees in one step', () => {
  store().close();
  store().load(
    projectDetail(1, [
      projectFile('trees/MainTree.json', 1, oneBlock('MainTree', 'Go')),
      projectFile('trees/Other.json', 1, oneBlock('Other', 'Go')),
    ]),
  );
  setValues([
    { tree: 'MainTree', node: 'n1', port: 'speed', text: '0.4' },
    { tree: 'Other', node: 'n1', port: 'speed', text: '0.5' },
  ]);
  expect([portOf('MainTree'), portOf('Other')]).toEqual(['0.4', '0.5']);
  store().undo('MainTree');
  expect([portOf('MainTree'), portOf('Other')]).toEqual([undefined, undefined]);
  setValues([]);
  expect(portOf('MainTree')).toBeUndefined();
});
