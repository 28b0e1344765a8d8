import { EditorView } from '@codemirror/view';
import { act, fireEvent, screen, waitFor } from '@testing-library/react';
import { beforeEach, describe, expect, it, vi } from 'vitest';
import { show } from '../../../harness/testing';
import { MergeView } from './MergeView';

const view = (name: string) => {
  const found = EditorView.findFromDOM(screen.getByRole('textbox', { name }));
  if (!found) throw new Error(`There is no editor ${name}.`);
  return found;
};
const text = (name: string) => view(name).state.doc.toString();

describe('MergeView', () => {
  it("shows both versions; only the user's can be edited", () => {
    const onChange = vi.fn();
    show(<MergeView path="a.py" theirs="theirs" mine="mine" onChange={onChange} />);
    expect([text('On the server'), text('Yours')]).toEqual(['theirs', 'mine']);
    expect([view('On the server').state.readOnly, view('Yours').state.readOnly]).toEqual([true, false]);
    expect(onChange).not.toHaveBeenCalled();
    act(() => view('Yours').dispatch({ changes: { from: 4, insert: ' too' } }));
    expect(onChange).toHaveBeenCalledExactlyOnceWith('mine too');
  });

  it("copies a piece from the server's version", async () => {
    const onChange = vi.fn();
    const { container } = show(
      <MergeView path="a.py" theirs={'a\nb\n'} mine={'a\nc\n'} onChange={onChange} />,
    );
    const arrow = await waitFor(() => {
      const found = container.querySelector('.cm-merge-revert button');
      if (!found) throw new Error('There is no arrow.');
      return found;
    });
    fireEvent.mouseDown(arrow);
    expect(text('Yours')).toBe('a\nb\n');
    expect(onChange).toHaveBeenLastCalledWith('a\nb\n');
    expect(text('On the server')).toBe('a\nb\n');
  });

  it('notifies the current listener', () => {
    const [first, second] = [vi.fn(), vi.fn()];
    const { rerender } = show(<MergeView path="a.py" theirs="" mine="" onChange={first} />);
    rerender(<MergeView path="a.py" theirs="" mine="" onChange={second} />);
    act(() => view('Yours').dispatch({ changes: { from: 0, insert: 'x' } }));
    expect(first).not.toHaveBeenCalled();
    expect(second).toHaveBeenCalledWith('x');
  });

  describe('in a narrow window', () => {
    beforeEach(() => {
      const listen = { addEventListener: () => undefined, removeEventListener: () => undefined };
      vi.spyOn(window, 'matchMedia').mockImplementation(
        (query) => ({ matches: query === '(max-width: 900px)', ...listen }) as unknown as MediaQueryList,
      );
    });

    it('is one text, where a difference can be taken from the server', async () => {
      const onChange = vi.fn();
      show(<MergeView path="a.py" theirs={'a\nb\n'} mine={'a\nc\n'} onChange={onChange} />);
      expect(screen.getAllByRole('textbox')).toHaveLength(1);
      expect(text('Yours')).toBe('a\nc\n');
      fireEvent.mouseDown(await screen.findByRole('button', { name: "Take the server's" }));
      expect(onChange).toHaveBeenLastCalledWith('a\nb\n');
    });

    it('is edited', () => {
      const onChange = vi.fn();
      show(<MergeView path="a.py" theirs="theirs" mine="mine" onChange={onChange} />);
      act(() => view('Yours').dispatch({ changes: { from: 4, insert: ' too' } }));
      expect(onChange).toHaveBeenCalledExactlyOnceWith('mine too');
    });
  });
});
