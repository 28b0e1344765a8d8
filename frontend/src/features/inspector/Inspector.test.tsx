import { act, screen, waitFor, within } from '@testing-library/react';
import { beforeEach, describe, expect, it } from 'vitest';
import { setCondition } from '@/model/edits';
import { toggleBreakpoint } from '@/store/debug/breakpoints';
import { useProjectStore } from '@/store/project';
import { change } from '@/store/project/edits/blocks';
import { useEditorStore } from '@/store/project/editor';
import { useLiveStore } from '@/store/project/live';
import { action, nodeOf, openProject, port, show, user, watchNavigation } from '../../../harness/testing';
import { basicPage } from '../../../harness/basicPage';
import { Inspector } from './Inspector';

const drive = action('Drive', {
  doc: 'Drives ahead.',
  ports: [
    port('speed', 'double', { default: '0.3', description: 'In metres a second.' }),
    port('count', 'int', { required: true }),
    port('isSlow', 'bool', { default: 'false' }),
    port('result', 'string', { direction: 'output' }),
  ],
});

const select = (...ids: string[]) => {
  act(() => {
    useProjectStore.getState().select('Main', ids);
  });
};

describe('Inspector', () => {
  beforeEach(() => {
    openProject({
      trees: {
        Main: {
          r: { type: 'Sequence', children: ['a', 's', 'p', 'x'] },
          a: { type: 'Drive', ports: { count: '2' } },
          s: { type: 'SubTree', tree: 'Dock' },
          p: { type: 'Parallel', children: [] },
          x: { type: 'Nowhere' },
        },
        Dock: { d: { type: 'AlwaysSuccess' } },
        Park: { d: { type: 'AlwaysSuccess' } },
        Loop: { d: { type: 'SubTree', tree: 'Main' } },
      },
      actions: [drive],
      texts: { 'actions/Drive.py': 'class Drive: ...' },
      selected: ['a'],
    });
    show(<Inspector />);
  });

  const field = (name: string) => screen.getByTestId<HTMLInputElement>(`port-${name}`);

  it('is empty while no block is selected', () => {
    select();
    expect(screen.getByText('Nothing selected')).toBeVisible();
    expect(screen.getByText(/Select a block/)).toBeVisible();
    expect(screen.queryByLabelText('Name')).toBeNull();
  });

  it('counts several selected blocks, and shows the fields of none', () => {
    select('a', 's');
    expect(screen.getByText('2 blocks selected')).toBeVisible();
    expect(screen.queryByText(/Select a block/)).toBeNull();
    expect(screen.queryByLabelText('Name')).toBeNull();
  });

  it('shows the fields of the block that is selected next', async () => {
    select('p');
    expect(await screen.findByRole('region', { name: 'Parallel' })).toBeVisible();
    expect(screen.queryByTestId('port-speed')).toBeNull();
  });

  it('renames the block in one step of undo', async () => {
    await user.type(screen.getByLabelText('Name'), 'go on');
    expect(nodeOf('Main', 'a')?.name).toBe('go on');
    expect(screen.getByRole('region', { name: 'go on' })).toBeVisible();
    act(() => {
      useProjectStore.getState().undo();
    });
    expect(nodeOf('Main', 'a')?.name).toBeUndefined();
    expect(screen.getByLabelText('Name')).toHaveValue('');
    expect(screen.getByLabelText('Name')).toHaveAttribute('placeholder', 'Drive');
  });

  it('offers other types at the button', async () => {
    await user.click(screen.getByRole('button', { name: 'Change type' }));
    expect(useEditorStore.getState().quickAdd).toMatchObject({
      tree: 'Main',
      goal: { does: 'morph', node: 'a' },
      text: '',
    });
  });

  it('opens the code of an action, and the tree of a subtree', async () => {
    const { openFile, openTree } = watchNavigation();
    await user.click(screen.getByRole('button', { name: 'Open code' }));
    expect(openFile).toHaveBeenCalledWith('actions/Drive.py');
    expect(screen.queryByRole('button', { name: 'Open tree' })).toBeNull();
    select('s');
    await user.click(await screen.findByRole('button', { name: 'Open tree' }));
    expect(openTree).toHaveBeenCalledWith('Dock');
    expect(screen.queryByRole('button', { name: 'Open code' })).toBeNull();
  });

  it('writes a port in one step of undo', async () => {
    await user.type(field('speed'), '1.5');
    expect(nodeOf('Main', 'a')?.ports).toEqual({ count: '2', speed: '1.5' });
    act(() => {
      useProjectStore.getState().undo();
    });
    expect(nodeOf('Main', 'a')?.ports).toEqual({ count: '2' });
  });

  it('marks a port whose text is no value of its type', async () => {
    await user.click(field('speed'));
    await user.paste('fast');
    expect(field('speed')).toBeInvalid();
    expect(field('count')).toBeValid();
    expect(screen.getByTestId('inspector')).toHaveTextContent(/fast/);
    await user.clear(field('speed'));
    expect(field('speed')).toBeValid();
    expect(nodeOf('Main', 'a')?.ports).toEqual({ count: '2' });
  });

  it('says that a required port is missing', async () => {
    expect(screen.getByText(/whole number · required/)).toBeVisible();
    await user.clear(field('count'));
    expect(field('count')).toBeInvalid();
  });

  it('adds a condition, checks its script, and removes it', async () => {
    await user.click(screen.getByRole('button', { name: 'Add condition' }));
    await user.click(await screen.findByRole('menuitem', { name: /Skip if/ }));
    expect(await screen.findByRole('textbox', { name: 'Skip if' })).toBeVisible();
    expect(nodeOf('Main', 'a')?.conditions).toBeUndefined();
    act(() => {
      change('condition', [setCondition('a', '_skipIf', 'speed <')]);
    });
    expect(screen.getByTestId('condition-_skipIf-error')).toBeVisible();
    await user.click(screen.getByRole('button', { name: 'Remove Skip if' }));
    expect(nodeOf('Main', 'a')?.conditions).toBeUndefined();
  });

  it('stores a comment', async () => {
    await user.click(screen.getByLabelText('Comment'));
    await user.paste('slow');
    expect(nodeOf('Main', 'a')?.comment).toBe('slow');
    await user.clear(screen.getByLabelText('Comment'));
    expect(nodeOf('Main', 'a')?.comment).toBeUndefined();
  });

  it('colours the block, and resets its colour to that of the family', async () => {
    const own = screen.getByRole('button', { name: 'Colour of the family' });
    expect(own).toHaveAttribute('aria-pressed', 'true');
    await user.click(screen.getByRole('button', { name: '#3f7d20' }));
    expect(nodeOf('Main', 'a')?.color).toBe('#3f7d20');
    expect(own).toHaveAttribute('aria-pressed', 'false');
    await user.click(own);
    expect(nodeOf('Main', 'a')?.color).toBeUndefined();
  });

  it('disables the block, and enables it', async () => {
    const disabled = screen.getByRole('switch', { name: /^Disabled/ });
    await user.click(disabled);
    expect(nodeOf('Main', 'a')?.disabled).toBe(true);
    expect(disabled).toBeChecked();
    await user.click(disabled);
    expect(nodeOf('Main', 'a')?.disabled).toBeUndefined();
  });

  it('offers a subtree any tree that does not contain it', async () => {
    select('s');
    const tree = await screen.findByRole('combobox', { name: 'Tree' });
    expect(tree).toHaveValue('Dock');
    await user.click(tree);
    const names = screen.getAllByRole('option').map(({ textContent }) => textContent);
    expect(names.sort()).toEqual(['Dock', 'Park']);
    await user.click(screen.getByRole('option', { name: 'Park' }));
    expect(nodeOf('Main', 's')).toMatchObject({ type: 'SubTree', tree: 'Park' });
  });

  it('describes the block and how many children it takes', async () => {
    expect(screen.getByText('Drives ahead.')).toBeVisible();
    expect(screen.queryByText(/^Children:/)).toBeNull();
    select('p');
    expect(await screen.findByText('Children: 1+')).toBeVisible();
  });

  it('shows the problem of a block of an unknown type', async () => {
    select('x');
    const panel = await screen.findByRole('region', { name: 'Nowhere' });
    expect(within(panel).getByRole('list')).toHaveTextContent(/Nowhere/);
    expect(within(panel).queryByText('About this node')).toBeNull();
  });

  it('shows the source of an action on demand', async () => {
    const toggle = screen.getByRole('button', { name: 'Show' });
    expect(toggle).toHaveAttribute('aria-expanded', 'false');
    await user.click(toggle);
    const source = await screen.findByRole('textbox', { name: 'Source of actions/Drive.py' });
    expect(source).toHaveTextContent('class Drive: ...');
    await user.click(screen.getByRole('button', { name: 'Hide' }));
    await waitFor(() => {
      expect(screen.queryByTestId('action-source')).toBeNull();
    });
  });

  it('shows the fault of the block in the last run', () => {
    act(() => {
      useLiveStore.setState({ faults: new Map([['Main/a', 'boom']]) });
    });
    expect(screen.getByTestId('fault-of-run')).toHaveTextContent('An action failed: boom');
    act(() => {
      useLiveStore.getState().clear();
    });
  });
});

describe('the basic page', () => {
  beforeEach(() => {
    basicPage();
    openProject({
      trees: { Main: { a: { type: 'Drive', ports: { count: '2' } } } },
      actions: [drive],
      selected: ['a'],
    });
    show(<Inspector />);
  });

  it('has the ports, and folds the rest', async () => {
    expect(screen.getByTestId('port-count')).toBeInTheDocument();
    expect(screen.queryByTestId('debug-section')).toBeNull();
    expect(screen.queryByRole('group', { name: 'Colour' })).toBeNull();
    await user.click(screen.getByText('More about this block'));
    expect(await screen.findByTestId('debug-section')).toBeInTheDocument();
  });

  it('shows what a block has', () => {
    act(() => change('condition', [setCondition('a', '_skipIf', 'x > 1')]));
    expect(screen.getByTestId('inspector-more')).toHaveAttribute('open');
    expect(screen.getByRole('button', { name: 'Remove Skip if' })).toBeInTheDocument();
  });

  it('shows the debugger of a block with a breakpoint', () => {
    act(() => toggleBreakpoint('Main', 'a'));
    expect(screen.getByTestId('debug-section')).toBeInTheDocument();
    act(() => toggleBreakpoint('Main', 'a'));
    expect(screen.queryByTestId('debug-section')).toBeNull();
  });
});
