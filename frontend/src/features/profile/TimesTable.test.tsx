import { screen } from '@testing-library/react';
import { expect, it } from 'vitest';
import '@/i18n/editorTexts';
import { treeNode } from '../../../harness/heldTree';
import { show } from '../../../harness/testing';
import { TimesTable } from './TimesTable';

const tree = Array.from({ length: 60 }, (_, index) => treeNode(index + 1, `n${index + 1}`));
const times = tree.map(({ uid }) => ({ uid, calls: 2, total_ms: uid, self_ms: uid }));

it('has the fifty slowest nodes, the slowest first, and passes over nodes of another tree', () => {
  const gone = { uid: 99, calls: 1, total_ms: 999, self_ms: 999 };
  show(<TimesTable tree={tree} times={[...times, gone]} wholeMs={100} canSample={false} />);
  const rows = screen.getAllByRole('row');
  expect(rows[1]).toHaveTextContent('n6060.0 %30000.030000.02');
  expect(rows).toHaveLength(50);
});

it('offers to sample leaves alone', () => {
  const leaf = { ...treeNode(1, 'c'), kind: 'Condition' };
  show(<TimesTable tree={[leaf, ...tree.slice(1)]} times={times} wholeMs={1} canSample />);
  expect(screen.queryAllByRole('button', { name: /^Sample/ })).toHaveLength(0);
  show(<TimesTable tree={[leaf]} times={times.slice(0, 1)} wholeMs={1} canSample />);
  expect(screen.getAllByRole('button', { name: 'Sample the Python code of c' })).toHaveLength(1);
});
