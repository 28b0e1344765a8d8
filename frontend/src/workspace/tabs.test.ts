import { expect, it } from 'vitest';
import { folderOf } from './tabs';

const file = (path: string) => ({ kind: 'file', path }) as const;

it('distinguishes tabs of one name by their folders', () => {
  const open = [file('actions/tones.py'), file('nodes/tones.py'), file('tones.py'), file('notes.md')];
  expect(open.map((tab) => folderOf(tab, open))).toEqual(['actions', 'nodes', '/', null]);
});

it('shows no folder for a unique name, also beside a tree', () => {
  const tree = { kind: 'tree', id: 'Main' } as const;
  expect(folderOf(file('actions/Go.py'), [file('actions/Go.py'), tree])).toBeNull();
  expect(folderOf(tree, [tree, file('Main')])).toBeNull();
});
