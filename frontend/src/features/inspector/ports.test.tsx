import { screen } from '@testing-library/react';
import { beforeEach, describe, expect, it } from 'vitest';
import { emptyDiagram } from '@/model/diagram';
import { useProjectStore } from '@/store/project';
import { knowing } from '@/store/project/transitions';
import { show, user } from '../../../harness/testing';
import { Inspector } from './Inspector';

const state = () => useProjectStore.getState();
const portsOf = (tree: string, node: string) => state().diagrams[tree]?.nodes[node]?.ports;

function treeOf(id: string, ...ids: string[]) {
  const leaves = Object.fromEntries(ids.map((each) => [each, { type: 'Old' }]));
  return { ...emptyDiagram(id), root: 'r', nodes: { r: { type: 'Sequence', children: ids }, ...leaves } };
}

describe('ports of an action that declares none', () => {
  beforeEach(() => {
    const diagrams = { Main: treeOf('Main', 'a', 'b'), Other: treeOf('Other', 'c') };
    const actions = [{ name: 'Old', kind: 'Action', open: true, ports: [] }];
    useProjectStore.setState((before) =>
      knowing({
        ...before,
        diagrams,
        actions,
        files: {},
        histories: {},
        activeTree: 'Main',
        selection: ['a'],
      }),
    );
    show(<Inspector />);
  });

  const add = async (name: string) => {
    await user.click(screen.getByRole('button', { name: 'Add port' }));
    await user.type(screen.getByLabelText('Name of the port'), `${name}{Enter}`);
  };

  it('get the caret in the value of a new one, named with Enter', async () => {
    await add('goal');
    expect(screen.getByTestId('port-goal')).toHaveFocus();
    await user.tab();
    expect(screen.getByTestId('port-goal')).not.toHaveFocus();
  });

  it('are added, renamed and removed on all its blocks, each in one step', async () => {
    await add('goal');
    expect([portsOf('Main', 'a'), portsOf('Main', 'b'), portsOf('Other', 'c')]).toEqual(
      Array(3).fill({ goal: '{goal}' }),
    );
    await user.click(screen.getByRole('button', { name: 'Rename port goal' }));
    await user.clear(screen.getByLabelText('Name of the port'));
    await user.type(screen.getByLabelText('Name of the port'), 'aim{Enter}');
    expect([portsOf('Main', 'b'), portsOf('Other', 'c')]).toEqual(Array(2).fill({ aim: '{goal}' }));
    await user.click(screen.getByRole('button', { name: 'Remove port aim' }));
    expect([portsOf('Main', 'a'), portsOf('Other', 'c')]).toEqual([undefined, undefined]);
    state().undo();
    state().undo();
    expect(portsOf('Other', 'c')).toEqual({ goal: '{goal}' });
  });

  it('cannot have a name that XML reserves, or that of another port', async () => {
    for (const name of ['name', '_skipIf', '3d']) {
      await add(name);
      expect(screen.getByText(/A letter first/)).toBeVisible();
      await user.keyboard('{Escape}');
    }
    await add('goal');
    await add('goal');
    expect(screen.getByText('There is a port of that name already.')).toBeVisible();
    await user.keyboard('{Escape}');
    expect(portsOf('Main', 'a')).toEqual({ goal: '{goal}' });
  });
});
