import { describe, expect, it } from 'vitest';
import { BIT } from '@/store/session/trace/nodeTrace';
import { treeNode } from '../../../harness/running';
import { plainName, rowsOf, statusesOf } from './rows';

describe('rowsOf', () => {
  const nodes = [
    treeNode(1, 0, 'root'),
    treeNode(2, 1, 'child'),
    treeNode(3, 2, 'Forward::3', { type: 'Forward' }),
    treeNode(4, 1, 'after', { type: 'Turn', tree_id: 'Other' }),
  ];

  it('are in the order of the tree, indented by depth', () => {
    expect(rowsOf(nodes, '').map(({ name, depth }) => [name, depth])).toEqual([
      ['root', 0],
      ['child', 1],
      ['Forward', 2],
      ['after', 1],
    ]);
  });

  it('link to their blocks', () => {
    expect(rowsOf(nodes, '').at(-1)).toEqual({
      uid: 4,
      name: 'after',
      type: 'Turn',
      depth: 1,
      node: 'n4',
      tree: 'Other',
    });
  });

  it.each([
    ['forw', [3]],
    [' FORW ', [3]],
    ['turn', [4]],
    ['after', [4]],
    ['sequence', [1, 2]],
    ['nothing', []],
    ['  ', [1, 2, 3, 4]],
  ])('finds %s by name or type', (search, uids) => {
    expect(rowsOf(nodes, search).map(({ uid }) => uid)).toEqual(uids);
  });

  it('indents no matches of a search', () => {
    expect(rowsOf(nodes, 'forward').map(({ depth }) => depth)).toEqual([0]);
  });
});

it.each([
  ['Forward::6', 'Forward'],
  ['drive', 'drive'],
  ['a::6b', 'a::6b'],
  ['', 'Kind'],
  ['::6', 'Kind'],
])('shows %s of a type Kind as %s', (name, plain) => {
  expect(plainName({ name, type: 'Kind' })).toBe(plain);
});

it('names the statuses of a stretch, the most important first', () => {
  const of = (mask: number) => statusesOf({ start: 0, end: 1, mask });
  expect(of(BIT.RUNNING)).toEqual(['RUNNING']);
  expect(of(BIT.SKIPPED | BIT.RUNNING | BIT.SUCCESS | BIT.FAILURE)).toEqual([
    'FAILURE',
    'SUCCESS',
    'RUNNING',
    'SKIPPED',
  ]);
  expect(of(0)).toEqual([]);
});
