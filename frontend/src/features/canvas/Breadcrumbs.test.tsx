import { act, screen } from '@testing-library/react';
import { describe, expect, it } from 'vitest';
import { useProjectStore } from '@/store/project';
import { now } from '../../../harness/canvas';
import { openProject, show, user, watchNavigation } from '../../../harness/testing';
import { Breadcrumbs } from './Breadcrumbs';

const deep = Object.fromEntries(
  Array.from({ length: 8 }, (_, at) => [
    `n${at}`,
    at < 7 ? { type: 'Inverter', name: `N${at}`, children: [`n${at + 1}`] } : { type: 'Sleep' },
  ]),
);
const calls = (tree: string) => ({ r: { type: 'SubTree', tree } });

function open(treeId: string, ...selected: string[]) {
  openProject({
    trees: {
      Main: { r: { type: 'Sequence', children: ['s'] }, s: { type: 'SubTree', tree: 'Dock' } },
      Dock: calls('Deep'),
      Deep: deep,
      Alone: { r: { type: 'Sleep' } },
      Ring: calls('Ring2'),
      Ring2: calls('Ring'),
    },
  });
  useProjectStore.getState().select(treeId, selected);
  show(<Breadcrumbs treeId={treeId} />);
}
const crumbs = () =>
  [...screen.getByRole('navigation').children]
    .filter((each) => each.tagName !== 'svg')
    .map(({ textContent }) => textContent);

describe('Breadcrumbs', () => {
  it('go from the main tree through its callers to this one', async () => {
    const { openTree } = watchNavigation();
    open('Deep');
    expect(crumbs()).toEqual(['Main', 'Dock', 'Deep']);
    await user.click(screen.getByRole('button', { name: 'Main' }));
    expect(openTree).toHaveBeenCalledExactlyOnceWith('Main');
  });

  it.each([
    ['Main', ['Main']],
    ['Alone', ['Alone']],
  ])('begin with %s, which no tree calls', (tree, expected) => {
    open(tree);
    expect(crumbs()).toEqual(expected);
  });

  it('end where trees call each other', () => {
    open('Ring');
    expect(crumbs()).toEqual(['Ring2', 'Ring']);
  });

  it('go to the selected block, which is the current one', async () => {
    open('Deep', 'n2');
    expect(crumbs()).toEqual(['Main', 'Dock', 'Deep', 'N0', 'N1', 'N2']);
    expect(screen.getByRole('button', { name: 'N2' })).toHaveAttribute('aria-current', 'true');
    expect(screen.getByRole('button', { name: 'N1' })).not.toHaveAttribute('aria-current');
    await user.click(screen.getByRole('button', { name: 'N1' }));
    expect(now.selection()).toEqual(['n1']);
    await user.click(screen.getByRole('button', { name: 'Deep' }));
    expect(now.selection()).toEqual([]);
  });

  it('show all of up to five blocks, otherwise the first and the last four', () => {
    open('Deep', 'n4');
    expect(crumbs().slice(3)).toEqual(['N0', 'N1', 'N2', 'N3', 'N4']);
    act(() => useProjectStore.getState().select('Deep', ['n5']));
    expect(crumbs().slice(3)).toEqual(['N0', '…', 'N2', 'N3', 'N4', 'N5']);
    expect(screen.getByText('…')).toHaveAttribute('title', 'N1');
    act(() => useProjectStore.getState().select('Deep', ['n7']));
    expect(crumbs().slice(3)).toEqual(['N0', '…', 'N4', 'N5', 'N6', 'Sleep']);
    expect(screen.getByText('…')).toHaveAttribute('title', 'N1 › N2 › N3');
  });

  it('leave out a block that is selected in another tree', () => {
    open('Deep', 'n2');
    act(() => useProjectStore.getState().select('Main', ['s']));
    expect(crumbs()).toEqual(['Main', 'Dock', 'Deep']);
  });
});
