import { EditorView } from '@codemirror/view';
import { act, screen } from '@testing-library/react';
import { beforeEach, describe, expect, it, vi } from 'vitest';
import { useProjectStore } from '@/store/project';
import { shownTarget } from '../../../harness/target';
import { nodeOf, openProject, show, user } from '../../../harness/testing';
import { ConditionList } from './ConditionList';

const List = shownTarget('Main', ConditionList);
const conditions = () => nodeOf('Main', 'a')?.conditions;
const names = () => screen.getAllByRole('menuitem').map((item) => item.querySelector('code')?.textContent);

beforeEach(async () => {
  openProject({
    trees: {
      Main: {
        r: { type: 'Sequence', children: ['a'] },
        a: { type: 'Sleep', conditions: { _post: 'x := 1', _while: 'y < 2' } },
      },
    },
    selected: ['a'],
  });
  show(<List id="a" />);
  await vi.waitUntil(() => document.querySelectorAll('.cm-content').length === 2);
});

/** Adds a condition; its field then has the caret. */
async function added() {
  await user.click(screen.getByRole('button', { name: 'Add condition' }));
  await user.click(await screen.findByRole('menuitem', { name: /On halt/ }));
  const field = await screen.findByRole('textbox', { name: 'On halt' });
  await vi.waitFor(() => expect(field).toHaveFocus());
  return field;
}

describe('ConditionList', () => {
  it('has the scripts of the block, in the order in which they run', () => {
    const fields = [...document.querySelectorAll('.cm-content')].map((each) =>
      each.getAttribute('aria-label'),
    );
    expect(fields).toEqual(['While', 'After']);
    expect(screen.getByRole('textbox', { name: 'While' })).toHaveTextContent('y < 2');
    expect(screen.getByText('_while')).toBeInTheDocument();
    expect(screen.queryByText('_skipIf')).toBeNull();
  });

  it('offers those that the block does not have', async () => {
    await user.click(screen.getByRole('button', { name: 'Add condition' }));
    await screen.findByRole('menuitem', { name: /Skip if/ });
    expect(names()).toEqual(['_skipIf', '_failureIf', '_successIf', '_onSuccess', '_onFailure', '_onHalted']);
    await user.click(screen.getByRole('menuitem', { name: /On halt/ }));
    const field = await screen.findByRole('textbox', { name: 'On halt' });
    await vi.waitFor(() => expect(field).toHaveFocus());
    expect(conditions()).toEqual({ _post: 'x := 1', _while: 'y < 2' });
    act(() => field.blur());
    await vi.waitFor(() => expect(conditions()).toEqual({ _post: 'x := 1', _while: 'y < 2', _onHalted: '' }));
  });

  it('adds a new one with its first character, and removes it with its last', async () => {
    const field = await added();
    const view = EditorView.findFromDOM(field)!;
    act(() => view.dispatch({ changes: { from: 0, insert: 'x' } }));
    expect(conditions()).toEqual({ _post: 'x := 1', _while: 'y < 2', _onHalted: 'x' });
    act(() => view.dispatch({ changes: { from: 0, to: 1 } }));
    expect(conditions()).toEqual({ _post: 'x := 1', _while: 'y < 2' });
    expect(field).toBeInTheDocument();
  });

  it('drops a new one with Escape', async () => {
    await added();
    await user.keyboard('{Escape}');
    expect(screen.queryByRole('textbox', { name: 'On halt' })).toBeNull();
    expect(screen.getByRole('button', { name: 'Add condition' })).toHaveFocus();
    expect(conditions()).toEqual({ _post: 'x := 1', _while: 'y < 2' });
  });

  it('removes one of them', async () => {
    await user.click(screen.getByRole('button', { name: 'Remove After' }));
    expect(conditions()).toEqual({ _while: 'y < 2' });
    expect(screen.queryByRole('textbox', { name: 'After' })).toBeNull();
  });

  it('writes a script in one step of undo', () => {
    const view = EditorView.findFromDOM(screen.getByRole('textbox', { name: 'While' }))!;
    for (const insert of ['0', '0'])
      act(() => view.dispatch({ changes: { from: view.state.doc.length, insert } }));
    expect(conditions()?.['_while']).toBe('y < 200');
    act(() => useProjectStore.getState().undo());
    expect(conditions()?.['_while']).toBe('y < 2');
  });
});
