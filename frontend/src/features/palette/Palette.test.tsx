import { act, fireEvent, screen, within } from '@testing-library/react';
import { beforeEach, describe, expect, it } from 'vitest';
import { useProjectStore } from '@/store/project';
import { offer } from '@/store/project/offered';
import { useEditorStore } from '@/store/project/editor';
import { action, fakeServer, openProject, show, user, watchNavigation } from '../../../harness/testing';
import { basicPage } from '../../../harness/basicPage';
import { Palette } from './Palette';

const nodes = () => Object.values(useProjectStore.getState().diagrams['Main']?.nodes ?? {});
const names = () => screen.queryAllByRole('button', { name: /^Add / }).map((item) => item.textContent);
const group = (name: RegExp) => screen.getByRole('button', { name });

describe('Palette', () => {
  beforeEach(() => {
    openProject({
      trees: { Main: { r: { type: 'Sequence', children: [] } }, Dock: { d: { type: 'AlwaysSuccess' } } },
      actions: [action('Grasp', { doc: 'Closes the hand.' }), action('SeesDoor', { kind: 'Condition' })],
      selected: ['r'],
    });
    show(<Palette />);
  });

  it('adds a block where it fits', async () => {
    await user.click(screen.getByRole('button', { name: 'Add Grasp' }));
    expect(nodes().map(({ type }) => type)).toEqual(['Sequence', 'Grasp']);
    expect(nodes()[0]?.children).toHaveLength(1);
  });

  it('adds a tree as a subtree, but not to itself', async () => {
    await user.click(screen.getByRole('button', { name: 'Add Dock' }));
    expect(nodes()[1]).toMatchObject({ type: 'SubTree', tree: 'Dock' });
    expect(screen.queryByRole('button', { name: 'Add Main' })).toBeNull();
  });

  it('groups the blocks by family, the user’s own first', () => {
    const titles = screen
      .getAllByRole('button', { expanded: true })
      .map(({ textContent }) => textContent.replace(/\d+$/, ''));
    expect(titles).toEqual([
      'Actions',
      'Conditions',
      'Control',
      'Decorators',
      'Subtrees',
      'Built-in actions',
      'ROS',
    ]);
    expect(group(/^Actions/)).toHaveTextContent('Actions1');
  });

  it('lists a block once that has several variants, and finds each', async () => {
    expect(names().filter((name) => /Switch|Loop/.test(name ?? ''))).toEqual(['Switch', 'Loop']);
    await user.type(screen.getByRole('textbox', { name: 'Search nodes' }), 'Switch4');
    expect(names()).toEqual(['Switch4']);
  });

  it('finds blocks by name, and by what they do', async () => {
    const search = screen.getByLabelText('Search nodes');
    await user.type(search, 'gra');
    expect(names()).toContain('Grasp');
    expect(names()).not.toContain('SeesDoor');
    await user.clear(search);
    await user.paste('the hand');
    expect(names()).toEqual(['Grasp']);
    await user.type(search, 'x');
    expect(screen.getByText('No node has this name.')).toBeInTheDocument();
  });

  it('offers the nodes of Nav2, folded, and lists them by kind once the project has them', async () => {
    const node = action('RecoveryNode', { kind: 'control', children: { min: 2, max: 2 } });
    act(() => offer([{ ...node, text: 'class RecoveryNode(ControlNode):\n    pass\n' }]));
    expect(screen.queryByRole('button', { name: 'Add RecoveryNode' })).toBeNull();
    await user.click(group(/^Nav2/));
    await user.click(screen.getByRole('button', { name: 'Add RecoveryNode' }));
    expect(nodes()[1]).toMatchObject({ type: 'RecoveryNode' });
    expect(screen.queryByRole('button', { name: /^Nav2/ })).toBeNull();
    expect(screen.getByRole('button', { name: 'Add RecoveryNode' })).toBeInTheDocument();
    act(() => offer([]));
  });

  it('folds a group, until a search opens it', async () => {
    await user.click(group(/^Actions/));
    expect(screen.queryByRole('button', { name: 'Add Grasp' })).toBeNull();
    await user.click(screen.getByLabelText('Search nodes'));
    await user.paste('Grasp');
    expect(screen.getByRole('button', { name: 'Add Grasp' })).toBeInTheDocument();
  });

  it('remembers what is dragged, until it is dropped', () => {
    const item = screen.getByRole('button', { name: 'Add Grasp' });
    const data = new Map<string, string>();
    const dataTransfer = { effectAllowed: '', setData: (kind: string, text: string) => data.set(kind, text) };
    fireEvent.dragStart(item, { dataTransfer });
    expect(useEditorStore.getState().dragged).toEqual({ type: 'Grasp' });
    expect(data.get('text/plain')).toBe('Grasp');
    expect(dataTransfer.effectAllowed).toBe('copy');
    fireEvent.dragEnd(item);
    expect(useEditorStore.getState().dragged).toBeNull();
  });

  describe('a new action', () => {
    beforeEach(() => user.click(screen.getByRole('button', { name: 'New action' })));
    const name = () => screen.getByLabelText('Name of the action');
    const create = () => screen.getByRole('button', { name: 'Create' });

    it('is written from a template and opened', async () => {
      const { openFile } = watchNavigation();
      expect(name()).toHaveFocus();
      await user.paste('IsNear');
      await user.click(within(screen.getByRole('radiogroup')).getByRole('radio', { name: 'Condition' }));
      await user.click(create());
      expect(useProjectStore.getState().currentText('actions/IsNear.py')).toContain('class IsNear');
      expect(useProjectStore.getState().currentText('actions/IsNear.py')).toContain('"Condition"');
      expect(openFile).toHaveBeenCalledWith('actions/IsNear.py');
      expect(screen.queryByLabelText('Name of the action')).toBeNull();
    });

    it.each(['3D', 'class', 'a b'])('cannot have the name “%s”', async (bad) => {
      expect(create()).toBeDisabled();
      await user.type(name(), `${bad}{Enter}`);
      expect(create()).toBeDisabled();
      expect(useProjectStore.getState().files).not.toHaveProperty([`actions/${bad}.py`]);
    });

    it('cannot have the name of another block', async () => {
      expect(name()).toHaveFocus();
      await user.paste('Sequence');
      expect(screen.getByText('This name is already in use.')).toBeInTheDocument();
      expect(create()).toBeDisabled();
    });

    it('is not made after Cancel', async () => {
      await user.click(screen.getByRole('button', { name: 'Cancel' }));
      expect(screen.queryByLabelText('Name of the action')).toBeNull();
    });
  });
});

it('shows the basic page the own blocks and six nodes, more on demand, and finds all of them', async () => {
  basicPage();
  openProject({
    trees: { Main: { r: { type: 'Sequence', children: [] } }, Dock: { d: { type: 'AlwaysSuccess' } } },
    actions: [action('Grasp')],
  });
  fakeServer({ 'GET /catalog/behaviours': [] });
  show(<Palette />);
  const six = ['Sequence', 'ReactiveSequence', 'Fallback', 'ReactiveFallback', 'Inverter'];
  expect(names()).toEqual(['Grasp', 'Dock', ...six, 'RetryUntilSuccessful']);
  await user.type(screen.getByLabelText('Search nodes'), 'Parallel');
  expect(names()).toContain('Parallel');
  await user.clear(screen.getByLabelText('Search nodes'));
  expect(names()).not.toContain('Parallel');
  await user.click(screen.getByRole('button', { name: 'More blocks…' }));
  expect(names()).toContain('Parallel');
});
