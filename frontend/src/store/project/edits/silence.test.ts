import { expect, it } from 'vitest';
import { useProjectStore } from '@/store/project';
import { nodeOf, openProject } from '../../../../harness/testing';
import { silence, unsilence } from './silence';

it('silences findings one by one, and reports them again', () => {
  openProject({ trees: { Main: { r: { type: 'ForceSuccess', children: [] } } } });
  silence('Main', 'r', 'BT0119', 'one');
  silence('Main', 'r', 'BT0402', 'two');
  expect(nodeOf('Main', 'r')?.silenced).toEqual({ BT0119: 'one', BT0402: 'two' });
  unsilence('Main', 'r', 'BT0119');
  expect(nodeOf('Main', 'r')?.silenced).toEqual({ BT0402: 'two' });
  unsilence('Main', 'r', 'BT0402');
  expect(nodeOf('Main', 'r')?.silenced).toBeUndefined();
  useProjectStore.getState().undo();
  expect(nodeOf('Main', 'r')?.silenced).toEqual({ BT0402: 'two' });
});
