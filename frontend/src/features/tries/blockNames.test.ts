import { expect, it } from 'vitest';
import { namesOf } from './blockNames';

const node = (uid: number, parent: number, name: string) => ({ uid, parent, name, path: `${name}::${uid}` });

it('names blocks by those that lead to them, and numbers those with the same names', () => {
  const tree = [node(1, 0, 'Main'), node(2, 1, 'Turn'), node(3, 1, 'Turn'), node(4, 3, 'Left')];
  expect([...namesOf(tree)]).toEqual([
    ['Main::1', 'Main'],
    ['Turn::2', 'Main › Turn'],
    ['Turn::3', 'Main › Turn (2)'],
    ['Left::4', 'Main › Turn › Left'],
  ]);
  expect(namesOf([])).toEqual(new Map());
});
