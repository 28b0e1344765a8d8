import { screen } from '@testing-library/react';
import { expect, it } from 'vitest';
import '@/i18n/editorTexts';
import { treeNode } from '../../../harness/heldTree';
import { show } from '../../../harness/testing';
import { FlameGraph } from './FlameGraph';

const tree = [treeNode(1, 'r'), treeNode(2, 'a')];

it('draws each node below its parent, as wide as its time', () => {
  const times = [
    { uid: 1, calls: 1, total_ms: 4, self_ms: 3 },
    { uid: 2, calls: 1, total_ms: 1, self_ms: 1 },
  ];
  show(<FlameGraph tree={tree} times={times} />);
  expect(screen.getByRole('img', { name: /flame graph/ })).toHaveStyle({ height: '40px' });
  expect(screen.getByText('a')).toHaveStyle({ left: '0%', width: '25%', top: '20px' });
  expect(screen.getByTitle('r: 4.00 ms, 3.00 ms of its own, in 1 tick')).toBeVisible();
});

it('is empty before the first tick', () => {
  show(<FlameGraph tree={tree} times={[]} />);
  expect(screen.getByTestId('flames')).toBeEmptyDOMElement();
});
