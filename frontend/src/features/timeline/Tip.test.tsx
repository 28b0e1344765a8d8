import { screen } from '@testing-library/react';
import { beforeEach, describe, expect, it } from 'vitest';
import { runTree, treeNode } from '../../../harness/running';
import { show } from '../../../harness/testing';
import { Tip } from './Tip';

const row = { uid: 2, name: 'drive', type: 'Forward', depth: 1, node: 'n2', tree: 'Main' };

beforeEach(() => {
  runTree([treeNode(1, 0, 'root'), treeNode(2, 1, 'drive')], { 1: [[2, 'RUNNING']], 3.5: [[2, 'IDLE']] }, 70);
});

const tip = () => screen.getByRole('presentation');

describe('Tip', () => {
  it.each([1.2, 3.4])('shows the status of the node at %s s, its start and its length', (time) => {
    show(<Tip x={10} y={100} row={row} time={time} />);
    expect(tip()).toHaveTextContent('drive running from 1 s for 2.50 s');
  });

  it.each([
    [0.5, '0.5 s'],
    [5, '5 s'],
    [65, '1:05'],
    [-3, '0 s'],
  ])('shows that it was idle at %s s', (time, label) => {
    show(<Tip x={10} y={100} row={row} time={time} />);
    expect(tip()).toHaveTextContent(`drive idle at ${label}`);
  });

  it('is beside the pointer, and inside of the window', () => {
    window.innerWidth = 1000;
    const { rerender } = show(<Tip x={10} y={100} row={row} time={1} />);
    expect(tip()).toHaveStyle({ left: '24px', top: '56px' });
    rerender(<Tip x={900} y={100} row={row} time={1} />);
    expect(tip()).toHaveStyle({ left: '740px' });
  });
});
