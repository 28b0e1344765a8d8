import { fireEvent, screen } from '@testing-library/react';
import { beforeEach, describe, expect, it, vi } from 'vitest';
import { childrenOf } from '@/model/diagram';
import { setEditor, useEditorStore, type QuickAdd as Request } from '@/store/project/editor';
import { useProjectStore } from '@/store/project';
import { now, openDiagram } from '../../../../harness/canvas';
import { action, nodeOf, show, user } from '../../../../harness/testing';
import { QuickAdd } from './QuickAdd';

beforeEach(() => {
  openDiagram(
    {
      root: 'r',
      nodes: { r: { type: 'Sequence', children: ['a', 'b'] }, a: { type: 'Sleep' }, b: { type: 'Grasp' } },
    },
    { actions: [action('Grasp', { doc: 'Closes the hand.' }), action('Release')] },
  );
});

/** Opens the box as the canvas does: when the request is removed, the box is closed. */
function open(more: Partial<Request> = {}) {
  const onClose = vi.fn();
  const place = { at: 'child', parent: 'r', index: 2 } as const;
  const request: Request = { tree: 'Main', goal: { does: 'add', place }, x: 100, y: 60, text: '', ...more };
  setEditor({ quickAdd: request });
  function Box() {
    const now = useEditorStore((state) => state.quickAdd);
    return now && <QuickAdd request={now} onClose={onClose} />;
  }
  show(<Box />);
  return onClose;
}

const box = () => screen.queryByTestId('quick-add');
const field = () => screen.getByRole('combobox');
const labels = () =>
  screen.getAllByRole('option').map((row) => row.querySelector('[class*=label]')!.textContent);
const active = () => screen.getAllByRole('option', { selected: true }).map(({ id }) => id);
const typeOf = (id: string | undefined) => nodeOf('Main', id ?? '')?.type;

describe('the list', () => {
  it('has the blocks that may be added, the user’s own first', () => {
    open();
    expect(labels().slice(0, 2)).toEqual(['Grasp', 'Release']);
    expect(labels()).toContain('Sequence');
    expect(box()).toHaveAccessibleName('Add a block…');
    expect(field()).toHaveFocus();
    expect(field()).toHaveAttribute('placeholder', 'Add a block…');
  });

  it('has decorators and controls to wrap one block in', () => {
    open({ goal: { does: 'wrap', nodes: ['a'] } });
    expect(labels()).toEqual(expect.arrayContaining(['Inverter', 'Sequence']));
    expect(labels()).not.toContain('Grasp');
    expect(field()).toHaveAccessibleName('Wrap in…');
  });

  it('has no decorators to wrap two blocks in', () => {
    open({ goal: { does: 'wrap', nodes: ['a', 'b'] } });
    expect(labels()).toContain('Sequence');
    expect(labels()).not.toContain('Inverter');
  });

  it('has the types that can have the present children', () => {
    open({ goal: { does: 'morph', node: 'r' } });
    expect(labels()).toContain('Fallback');
    expect(labels()).not.toContain('Inverter');
    expect(labels()).not.toContain('Grasp');
    expect(field()).toHaveAccessibleName('Change type to…');
  });

  it('starts with the text that was typed, and follows it', async () => {
    open({ text: 'gra' });
    expect(field()).toHaveValue('gra');
    expect(labels()[0]).toBe('Grasp');
    await user.clear(field());
    await user.type(field(), 'the hand');
    expect(labels()).toEqual(['Grasp']);
  });

  it('says that no block matches', async () => {
    open({ text: 'Grasp' });
    expect(screen.queryByText('Nothing that fits here has this name.')).toBeNull();
    await user.type(field(), ' no');
    expect(screen.queryAllByRole('option')).toEqual([]);
    expect(screen.getByText('Nothing that fits here has this name.')).toBeInTheDocument();
    expect(field()).not.toHaveAttribute('aria-activedescendant');
    await user.keyboard('{ArrowDown}{ArrowUp}{Enter}');
    expect(childrenOf(now.diagram(), 'r')).toEqual(['a', 'b']);
  });

  it('is empty for a deleted tree', () => {
    open({ tree: 'Gone' });
    expect(screen.queryAllByRole('option')).toEqual([]);
  });
});

describe('keys', () => {
  it('go round in the list, and a search starts at its top again', async () => {
    open({ text: 'Reactive' });
    const last = labels().length - 1;
    expect(active()).toEqual(['quick-add-0']);
    await user.keyboard('{ArrowDown}{ArrowDown}{ArrowUp}');
    expect(active()).toEqual(['quick-add-1']);
    expect(field()).toHaveAttribute('aria-activedescendant', 'quick-add-1');
    expect(last).toBeGreaterThan(2);
    await user.keyboard('{ArrowUp}{ArrowUp}');
    expect(active()).toEqual([`quick-add-${last}`]);
    await user.keyboard('{ArrowDown}');
    expect(active()).toEqual(['quick-add-0']);
    await user.keyboard('{ArrowDown}S');
    expect(active()).toEqual(['quick-add-0']);
  });

  it.each(['{Enter}', '{Tab}'])('%s adds the active one and closes the box', async (key) => {
    const onClose = open();
    await user.keyboard(`{ArrowDown}${key}`);
    const added = childrenOf(now.diagram(), 'r')[2];
    expect(typeOf(added)).toBe('Release');
    expect(now.selection()).toEqual([added]);
    expect(onClose).toHaveBeenCalledOnce();
    expect(box()).toBeNull();
  });

  it('Escape closes the box and adds nothing', async () => {
    const onClose = open({ text: 'Gra' });
    await user.keyboard('{Escape}');
    expect(onClose).toHaveBeenCalledOnce();
    expect(box()).toBeNull();
    expect(childrenOf(now.diagram(), 'r')).toEqual(['a', 'b']);
  });

  it('do not reach the canvas', () => {
    const onKey = vi.fn();
    document.addEventListener('keydown', onKey);
    open({ text: 'Gra' });
    fireEvent.keyDown(field(), { key: 'Delete' });
    document.removeEventListener('keydown', onKey);
    // React's listener is at the root, below the document.
    expect(onKey).not.toHaveBeenCalled();
  });
});

describe('a choice', () => {
  it('is made with a press', () => {
    open();
    fireEvent.pointerDown(screen.getAllByRole('button')[1]!);
    expect(typeOf(childrenOf(now.diagram(), 'r')[2])).toBe('Release');
  });

  it('wraps the blocks', async () => {
    open({ goal: { does: 'wrap', nodes: ['a', 'b'] }, text: 'Fallback' });
    await user.keyboard('{Enter}');
    const [around] = childrenOf(now.diagram(), 'r');
    expect(typeOf(around)).toBe('Fallback');
    expect(childrenOf(now.diagram(), around!)).toEqual(['a', 'b']);
  });

  it('changes the type', async () => {
    open({ goal: { does: 'morph', node: 'a' }, text: 'Release' });
    await user.keyboard('{Enter}');
    expect(typeOf('a')).toBe('Release');
  });
});

describe('a name without a matching block', () => {
  it('becomes a new action, written from a template', async () => {
    open({ text: 'PickUp' });
    expect(screen.getByTestId('quick-add-new-Action')).toHaveTextContent('New action “PickUp”');
    expect(screen.getByTestId('quick-add-new-Condition')).toHaveTextContent('New condition “PickUp”');
    await user.keyboard('{Enter}');
    expect(typeOf(childrenOf(now.diagram(), 'r')[2])).toBe('PickUp');
    const text = useProjectStore.getState().currentText('actions/PickUp.py');
    expect(text).toContain('class PickUp');
    expect(text).not.toContain('NODE_KIND');
  });

  it('that is a question becomes a condition first', () => {
    open({ text: 'IsHome' });
    const made = screen.getAllByTestId(/^quick-add-new-/).map(({ dataset }) => dataset['testid']);
    expect(made).toEqual(
      ['Condition', 'Action', 'Control', 'Decorator'].map((kind) => `quick-add-new-${kind}`),
    );
  });

  it('can become the other kind with a press', () => {
    open({ text: 'PickUp' });
    fireEvent.pointerDown(screen.getByTestId('quick-add-new-Condition'));
    expect(useProjectStore.getState().currentText('actions/PickUp.py')).toContain('NODE_KIND = "Condition"');
    expect(box()).toBeNull();
  });

  it('is offered even if a description contains the word, but not if a block’s name starts with it', async () => {
    open({ text: 'Hand' });
    expect(labels()[0]).toBe('Grasp');
    expect(screen.getByRole('option', { selected: true })).toHaveTextContent('New action “Hand”');
    await user.clear(field());
    await user.type(field(), 'Gras');
    expect(active()).toEqual(['quick-add-0']);
    expect(screen.getByTestId('quick-add-new-Action')).toBeInTheDocument();
  });

  it.each(['Grasp', '3D', 'a b', 'class'])('is not offered for “%s”', (name) => {
    open({ text: name });
    expect(screen.queryByTestId('quick-add-new-Action')).toBeNull();
  });

  it('becomes a decorator round one block', async () => {
    open({ goal: { does: 'wrap', nodes: ['a'] }, text: 'Twice' });
    expect(labels()).toEqual(['New decorator “Twice”', 'New control node “Twice”']);
    await user.keyboard('{Enter}');
    const [around] = childrenOf(now.diagram(), 'r');
    expect(typeOf(around)).toBe('Twice');
    expect(childrenOf(now.diagram(), around!)).toEqual(['a']);
    expect(useProjectStore.getState().currentText('actions/Twice.py')).toContain(
      'class Twice(DecoratorNode)',
    );
  });

  it('becomes a control node round two blocks', () => {
    open({ goal: { does: 'wrap', nodes: ['a', 'b'] }, text: 'InTurn' });
    expect(labels()).toEqual(['New control node “InTurn”']);
  });

  it('becomes the type of a block, of a kind that can have its children', async () => {
    open({ goal: { does: 'morph', node: 'r' }, text: 'InTurn' });
    expect(labels()).toEqual(['New control node “InTurn”']);
    await user.keyboard('{Enter}');
    expect(typeOf('r')).toBe('InTurn');
    expect(childrenOf(now.diagram(), 'r')).toEqual(['a', 'b']);
  });
});

describe('the box', () => {
  it.each([
    [
      { x: 100, y: 60 },
      { left: '100px', top: '60px' },
    ],
    [
      { x: -50, y: -50 },
      { left: '8px', top: '8px' },
    ],
    [
      { x: 5000, y: 5000 },
      { left: `${1024 - 348}px`, top: `${768 - 388}px` },
    ],
  ])('opened at %o stays within the window', (point, place) => {
    open({ ...point, text: 'no such' });
    expect(box()).toHaveStyle({ ...place, width: '340px', maxHeight: '380px' });
  });

  it('closes when the focus leaves it, but not when the focus moves inside', () => {
    open({ text: 'Gra' });
    fireEvent.blur(field(), { relatedTarget: screen.getAllByRole('button')[0]! });
    expect(box()).not.toBeNull();
    fireEvent.blur(field(), { relatedTarget: document.body });
    expect(now.editor().quickAdd).toBeNull();
  });
});
