import { IconBox, IconWorld } from '@tabler/icons-react';
import { act, fireEvent, screen, waitFor } from '@testing-library/react';
import { describe, expect, it, vi } from 'vitest';
import { lookOnly, openUniverse } from '../../../harness/documents';
import { show, user } from '../../../harness/testing';
import { select, type Editor } from './editing';
import { ThingList } from './ThingList';

const THINGS = ['a', 'b', 'c', 'd'].map((key) => ({ key, name: `Thing ${key}`, icon: IconBox }));

function list(canRename = true, prepare: (editor: Editor) => void = () => undefined) {
  const editor = openUniverse();
  prepare(editor);
  const calls = { onDuplicate: vi.fn(), onDelete: vi.fn(), onRename: vi.fn() };
  show(
    <ThingList
      editor={editor}
      title="4 things"
      things={[{ ...THINGS[0]!, color: '#ff0000' }, ...THINGS.slice(1)]}
      whole={{ label: 'The world', icon: IconWorld }}
      onDuplicate={calls.onDuplicate}
      onDelete={calls.onDelete}
      {...(canRename
        ? {
            onRename: calls.onRename,
            nameProblem: (_: string, name: string) => (name === 'bad' ? 'No' : null),
          }
        : {})}
    />,
  );
  return { editor, ...calls, selection: () => editor.store.getState().selection };
}

const row = (key: string) => screen.getByTestId(`thing-${key}`);
const chosen = () =>
  screen
    .getAllByRole('option')
    .filter((each) => each.getAttribute('aria-selected') === 'true')
    .map(({ dataset }) => dataset['key']);

describe('ThingList', () => {
  it('lists every thing, with its colour; the first can be reached by Tab', () => {
    list();
    expect(screen.getByRole('listbox', { name: '4 things' })).toHaveAttribute('aria-multiselectable', 'true');
    expect(screen.getAllByRole('option').map(({ textContent }) => textContent)).toEqual([
      'Thing a',
      'Thing b',
      'Thing c',
      'Thing d',
    ]);
    expect(screen.getAllByRole('option').map(({ tabIndex }) => tabIndex)).toEqual([0, -1, -1, -1]);
    expect(row('a').querySelector('[style*="background"]')).not.toBeNull();
    expect(row('b').querySelector('[style*="background"]')).toBeNull();
  });

  it('selects by clicks: one, toggled with Control, a range with Shift', async () => {
    const { selection } = list();
    await user.click(row('b'));
    expect(chosen()).toEqual(['b']);
    expect(row('b').tabIndex).toBe(0);
    expect(row('a').tabIndex).toBe(-1);
    fireEvent.click(row('d'), { ctrlKey: true });
    expect(selection()).toEqual(['b', 'd']);
    fireEvent.click(row('b'), { metaKey: true });
    expect(selection()).toEqual(['d']);
    fireEvent.click(row('b'), { shiftKey: true });
    expect(selection()).toEqual(['b', 'c', 'd']);
    await user.click(row('a'));
    fireEvent.click(row('c'), { shiftKey: true });
    expect(selection()).toEqual(['a', 'b', 'c']);
  });

  it('selects one if Shift has no start', () => {
    const { selection } = list();
    fireEvent.click(row('c'), { shiftKey: true });
    expect(selection()).toEqual(['c']);
  });

  it('goes up and down with the arrows, to the ends and not beyond', async () => {
    const { selection } = list();
    const press = (key: string) => fireEvent.keyDown(screen.getByRole('listbox'), { key });
    press('ArrowDown');
    expect(selection()).toEqual(['a']);
    press('ArrowUp');
    expect(selection()).toEqual(['a']);
    press('ArrowDown');
    expect(selection()).toEqual(['b']);
    await waitFor(() => expect(row('b')).toHaveFocus());
    for (let count = 0; count < 5; count += 1) press('ArrowDown');
    expect(selection()).toEqual(['d']);
  });

  it('deletes and copies by keys and by buttons', async () => {
    const { editor, onDelete, onDuplicate } = list();
    const above = vi.fn();
    document.body.addEventListener('keydown', above);
    const press = (key: string, more = {}) => fireEvent.keyDown(row('a'), { key, ...more });
    press('Delete');
    expect(onDelete).toHaveBeenCalledOnce();
    press('d', { ctrlKey: true });
    press('D', { metaKey: true });
    expect(onDuplicate).toHaveBeenCalledTimes(2);
    expect(above).not.toHaveBeenCalled();
    press('d');
    press('x');
    expect(onDuplicate).toHaveBeenCalledTimes(2);
    expect(above).toHaveBeenCalledTimes(2);
    document.body.removeEventListener('keydown', above);
    for (const name of ['The world', 'Duplicate (Ctrl+D)', 'Delete (Del)'])
      expect(screen.getByRole('button', { name })).toBeDisabled();
    act(() => select(editor, ['a']));
    await user.click(screen.getByRole('button', { name: 'Duplicate (Ctrl+D)' }));
    await user.click(screen.getByRole('button', { name: 'Delete (Del)' }));
    expect([onDuplicate.mock.calls.length, onDelete.mock.calls.length]).toEqual([3, 2]);
    await user.click(screen.getByRole('button', { name: 'The world' }));
    expect(editor.store.getState().selection).toEqual([]);
  });

  it('renames with F2 and with a double click', async () => {
    const { editor, onRename } = list();
    act(() => select(editor, ['b']));
    fireEvent.keyDown(row('b'), { key: 'F2' });
    const field = screen.getByRole('textbox', { name: 'Name' });
    expect(field).toHaveValue('Thing b');
    expect(field).toHaveFocus();
    await user.clear(field);
    await user.type(field, 'chest{Enter}');
    expect(onRename).toHaveBeenCalledWith('b', 'chest');
    expect(screen.queryByRole('textbox')).toBeNull();
    await user.dblClick(row('c'));
    await user.keyboard('x{Escape}');
    expect(screen.queryByRole('textbox')).toBeNull();
    expect(onRename).toHaveBeenCalledOnce();
  });

  it('refuses a name with its reason, and keeps the list unchanged meanwhile', async () => {
    const { onRename, onDelete, selection } = list();
    await user.dblClick(row('c'));
    const field = screen.getByRole('textbox', { name: 'Name' });
    await user.clear(field);
    await user.type(field, 'bad{Delete}{ArrowDown}');
    expect(screen.getByText('No')).toBeInTheDocument();
    expect(onDelete).not.toHaveBeenCalled();
    expect(selection()).toEqual(['c']);
    await user.keyboard('{Enter}');
    expect(onRename).not.toHaveBeenCalled();
    expect(screen.queryByRole('textbox')).toBeNull();
  });

  it('applies the name when the focus leaves the field', async () => {
    const { onRename } = list();
    await user.dblClick(row('d'));
    await user.keyboard('e');
    await user.click(screen.getByRole('heading'));
    expect(onRename).toHaveBeenCalledExactlyOnceWith('d', 'e');
  });

  it('renames nothing if things have no names, or in a read-only project', async () => {
    const { editor } = list(false);
    act(() => select(editor, ['a']));
    fireEvent.keyDown(row('a'), { key: 'F2' });
    await user.dblClick(row('a'));
    expect(screen.queryByRole('textbox')).toBeNull();
  });

  it('changes nothing in a read-only project', async () => {
    list(true, (editor) => {
      select(editor, ['a']);
      lookOnly();
    });
    await user.dblClick(row('a'));
    expect(screen.queryByRole('textbox')).toBeNull();
    expect(screen.getByRole('button', { name: 'Duplicate (Ctrl+D)' })).toBeDisabled();
    expect(screen.getByRole('button', { name: 'Delete (Del)' })).toBeDisabled();
    expect(screen.getByRole('button', { name: 'The world' })).toBeEnabled();
  });

  it('scrolls to the last selected row', () => {
    const { editor } = list();
    const into = vi.spyOn(Element.prototype, 'scrollIntoView');
    act(() => select(editor, ['a', 'd']));
    expect(into.mock.contexts).toEqual([row('d')]);
    expect(into).toHaveBeenCalledWith({ block: 'nearest' });
  });
});
