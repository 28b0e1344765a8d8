import { act, waitFor } from '@testing-library/react';
import { beforeEach, describe, expect, it, onTestFinished, vi } from 'vitest';
import { childrenOf } from '@/model/diagram';
import { useLiveStore } from '@/store/project/live';
import { useProjectStore } from '@/store/project';
import { useWhy } from '@/store/moment/why';
import { useSessionStore } from '@/store/session/store';
import { oneBlock } from '@/store/testing';
import { now, openDiagram } from '../../../../harness/canvas';
import { action, nodeOf, watchNavigation } from '../../../../harness/testing';
import { blockCommands } from './blockCommands';

let isVisible = true;
let clipboard = '';

beforeEach(() => {
  isVisible = true;
  // jsdom has neither a layout nor a clipboard.
  Element.prototype.checkVisibility = () => isVisible;
  clipboard = '';
  vi.stubGlobal('navigator', {
    clipboard: {
      readText: () => Promise.resolve(clipboard),
      writeText: (text: string) => {
        clipboard = text;
        return Promise.resolve();
      },
    },
  });
  document.body.innerHTML = '<div data-testid="canvas" data-tree="Main" tabindex="0"></div><input>';
  document.querySelector<HTMLElement>('[data-testid="canvas"]')!.focus();
  openDiagram(
    {
      root: 'r',
      nodes: {
        r: { type: 'Sequence', children: ['a', 'i', 's', 'g', 'w', 'v'] },
        a: { type: 'Sleep', ports: { msec: '5' } },
        i: { type: 'Inverter', children: ['x'] },
        x: { type: 'AlwaysSuccess' },
        s: { type: 'SubTree', tree: 'Dock' },
        g: { type: 'Grasp' },
        w: { type: 'Nowhere' },
        v: { type: 'SubTree', tree: 'Gone' },
      },
    },
    { actions: [action('Grasp')], texts: { 'trees/Dock.json': oneBlock('Dock', 'AlwaysSuccess') } },
  );
  onTestFinished(() => {
    document.body.innerHTML = '';
    vi.unstubAllGlobals();
  });
});

const command = (id: string) => blockCommands.find((each) => each.id === id)!;
const run = (id: string) => command(id).run();
const select = (...ids: string[]) => useProjectStore.getState().select('Main', ids);
const enabled = (): string[] =>
  blockCommands.filter((each) => each.enabled?.() !== false).map(({ id }) => id);
const children = () => childrenOf(now.diagram(), 'r');
const typesOf = (ids: readonly string[]) => ids.map((id) => nodeOf('Main', id)?.type);

/** The commands that are available for every selected block. */
const COMMON = [
  'edit.copy',
  'edit.cut',
  'edit.paste',
  'edit.duplicate',
  'edit.delete',
  'canvas.add',
  'canvas.addAfter',
  'canvas.rename',
  'canvas.comment',
  'canvas.wrap',
  'canvas.wrapSequence',
  'canvas.wrapFallback',
  'canvas.unwrap',
  'canvas.morph',
  'canvas.disable',
];

describe('the commands of a block', () => {
  it.each([
    ['a', []],
    ['i', ['canvas.fold', 'canvas.extract']],
    ['s', ['canvas.open', 'canvas.look', 'canvas.inline']],
    ['g', ['canvas.open']],
    ['w', ['canvas.fix']],
    ['v', ['canvas.open', 'canvas.fix', 'canvas.inline']],
  ])('for %s are the common ones and %o', (id, more) => {
    select(id);
    expect(enabled().sort()).toEqual([...COMMON, ...more].sort());
  });

  it('are few without a selection', () => {
    expect(enabled()).toEqual(['edit.paste', 'canvas.add']);
  });

  it('leave the clipboard and duplicating to the field that has the focus', () => {
    select('a');
    document.querySelector('input')!.focus();
    const texts = ['edit.copy', 'edit.cut', 'edit.paste', 'edit.duplicate'];
    expect(enabled()).toEqual(COMMON.filter((id) => !texts.includes(id)));
  });

  it('are those of the clipboard if the tree is not visible', () => {
    select('i');
    isVisible = false;
    expect(enabled()).toEqual(['edit.copy', 'edit.cut', 'edit.paste', 'edit.duplicate']);
  });

  it('extract several consecutive blocks', () => {
    select('a', 'i');
    expect(enabled()).toContain('canvas.extract');
    select('a', 'g');
    expect(enabled()).not.toContain('canvas.extract');
  });

  it('wrap several blocks at once', () => {
    select('a', 'i');
    run('canvas.wrapFallback');
    expect(typesOf(children())).toEqual(['Fallback', 'SubTree', 'Grasp', 'Nowhere', 'SubTree']);
    expect(childrenOf(now.diagram(), children()[0]!)).toEqual(['a', 'i']);
  });
});

describe('the labels in the menu', () => {
  const words = (id: string, isOnBlock = true) => command(id).inMenu(isOnBlock);

  it.each([
    ['a', 'canvas.add', null],
    ['r', 'canvas.add', 'addChild'],
    ['i', 'canvas.add', null],
    ['s', 'canvas.open', 'openTree'],
    ['g', 'canvas.open', 'openCode'],
    ['a', 'canvas.open', null],
    ['a', 'canvas.fold', null],
    ['i', 'canvas.fold', 'fold'],
    ['a', 'canvas.unwrap', null],
    ['i', 'canvas.unwrap', 'unwrap'],
    ['r', 'canvas.unwrap', 'unwrap'],
    ['a', 'canvas.disable', 'disable'],
    ['a', 'canvas.fix', null],
    ['w', 'canvas.fix', 'fix'],
    ['a', 'canvas.extract', null],
    ['i', 'canvas.extract', 'extract'],
    ['a', 'canvas.look', null],
    ['s', 'canvas.look', 'lookInside'],
    ['v', 'canvas.look', null],
    ['a', 'canvas.inline', null],
    ['s', 'canvas.inline', 'inline'],
  ])('on %s of %s are %s', (id, of, expected) => {
    select(id);
    expect(words(of)).toBe(expected);
  });

  it('follow the state of the block', () => {
    select('i');
    run('canvas.fold');
    expect(words('canvas.fold')).toBe('unfold');
    run('canvas.disable');
    expect(words('canvas.disable')).toBe('enable');
    select('s');
    run('canvas.look');
    expect(words('canvas.look')).toBe('lookAway');
  });

  it('on the empty canvas add a block', () => {
    select('a');
    expect(words('canvas.add', false)).toBe('addBlock');
  });

  it('include those for a fault of the last run', () => {
    select('a');
    useLiveStore.setState({ faults: new Map([['Main/a', 'boom']]) });
    expect(words('canvas.fix')).toBe('fix');
  });
});

describe('running', () => {
  it('copy, cut and paste use the clipboard', async () => {
    select('a');
    run('edit.copy');
    await waitFor(() => expect(clipboard).toContain('<Sleep msec="5"/>'));
    expect(children()).toContain('a');
    select('g');
    run('edit.cut');
    await waitFor(() => expect(children()).not.toContain('g'));
    select('r');
    run('edit.paste');
    await waitFor(() => expect(typesOf(children())).toContain('Grasp'));
  });

  it('duplicate and delete change the tree', () => {
    select('a');
    run('edit.duplicate');
    expect(typesOf(children()).slice(0, 2)).toEqual(['Sleep', 'Sleep']);
    expect(now.selection()).toEqual([children()[1]]);
    run('edit.delete');
    expect(children()).toHaveLength(6);
  });

  it.each([
    ['canvas.add', { does: 'add', place: { at: 'child', parent: 'r', index: 2 } }],
    ['canvas.addAfter', { does: 'add', place: { at: 'child', parent: 'r', index: 2 } }],
    ['canvas.wrap', { does: 'wrap', nodes: ['i'] }],
    ['canvas.morph', { does: 'morph', node: 'i' }],
  ])('%s opens the quick-add box', (id, goal) => {
    select('i');
    run(id);
    expect(now.editor().quickAdd?.goal).toEqual(goal);
  });

  it.each([
    ['canvas.rename', 'name'],
    ['canvas.comment', 'comment'],
  ])('%s edits the %s on the block', (id, field) => {
    select('a');
    run(id);
    expect(now.editor().editing).toEqual({ node: 'a', field });
  });

  it('open opens the code or the tree', () => {
    const { openFile, openTree } = watchNavigation();
    select('g');
    run('canvas.open');
    expect(openFile).toHaveBeenCalledWith('actions/Grasp.py');
    select('s');
    run('canvas.open');
    expect(openTree).toHaveBeenCalledWith('Dock');
  });

  it('fold, disable and unwrap change the block', () => {
    select('i');
    run('canvas.fold');
    expect(nodeOf('Main', 'i')?.collapsed).toBe(true);
    run('canvas.disable');
    expect(nodeOf('Main', 'i')?.disabled).toBe(true);
    run('canvas.disable');
    expect(nodeOf('Main', 'i')?.disabled).toBeUndefined();
    run('canvas.unwrap');
    expect(children().slice(0, 3)).toEqual(['a', 'x', 's']);
  });

  it('extract and inline move blocks to a tree and back', () => {
    select('i');
    run('canvas.extract');
    const id = children()[1]!;
    expect(nodeOf('Main', id)?.type).toBe('SubTree');
    select(id);
    run('canvas.inline');
    expect(typesOf(children()).slice(0, 3)).toEqual(['Sleep', 'Inverter', 'SubTree']);
  });

  it('fix shows the fixes after the menu is closed', async () => {
    select('w');
    run('canvas.fix');
    expect(now.editor().fixing).toBeNull();
    await waitFor(() => expect(now.editor().fixing).toBe('w'));
  });

  it('look expands a subtree', () => {
    select('s');
    act(() => run('canvas.look'));
    expect(now.editor().expanded['Main']).toEqual(new Set(['s']));
  });
});

it('has a key, an icon and a label for each', () => {
  const ids = blockCommands.map(({ id }) => id);
  expect(new Set(ids).size).toBe(ids.length);
  const keys = Object.fromEntries(blockCommands.map(({ id, shortcut, keys }) => [id, shortcut ?? keys]));
  expect(keys).toEqual({
    'edit.copy': '$mod+KeyC',
    'edit.cut': '$mod+KeyX',
    'edit.paste': '$mod+KeyV',
    'edit.duplicate': '$mod+KeyD',
    'edit.delete': 'Delete',
    'canvas.add': 'Tab',
    'canvas.addAfter': '$mod+Enter',
    'canvas.rename': 'F2',
    'canvas.comment': 'Slash',
    'canvas.open': 'Enter',
    'canvas.fold': 'Space',
    'canvas.wrap': '$mod+KeyG',
    'canvas.unwrap': '$mod+Shift+KeyG',
    'canvas.morph': '$mod+KeyM',
    'canvas.disable': '$mod+KeyE',
    'canvas.fix': '$mod+Period',
    'canvas.why': 'Alt+KeyW',
    'canvas.extract': undefined,
    'canvas.look': 'Space',
    'canvas.inline': undefined,
  });
});

it('why a block was ticked is asked of blocks of the tree that runs', () => {
  select('a');
  expect(command('canvas.why').inMenu(true)).toBeNull();
  const tree = [
    { uid: 1, parent: 0, type: 'Sleep', kind: '', name: '', path: '', node_id: 'a', tree_id: 'Main' },
  ];
  useSessionStore.setState({ tree });
  onTestFinished(() => useSessionStore.setState({ tree: [] }));
  expect(command('canvas.why').inMenu(true)).toBe('why');
  const { asked } = useWhy.getState();
  vi.useFakeTimers();
  run('canvas.why');
  vi.runAllTimers();
  vi.useRealTimers();
  expect(useWhy.getState()).toEqual({ isOpen: true, asked: asked + 1 });
  select('a', 'g');
  expect(command('canvas.why').enabled?.()).toBe(false);
});
