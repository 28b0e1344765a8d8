import { completionStatus, currentCompletions, startCompletion } from '@codemirror/autocomplete';
import { forEachDiagnostic } from '@codemirror/lint';
import { EditorView } from '@codemirror/view';
import { act, screen } from '@testing-library/react';
import { useState } from 'react';
import { describe, expect, it, onTestFinished, vi } from 'vitest';
import { useProjectStore } from '@/store/project';
import { show } from '../../../harness/testing';
import { ScriptEditor } from './ScriptEditor';

let setText: (text: string) => void;

function open(start: string, more: { labelledBy?: string; label?: string } = { label: 'While' }) {
  const onChange = vi.fn();
  function Field() {
    const [value, setValue] = useState(start);
    setText = setValue;
    return (
      <>
        <b id="name">Named</b>
        <ScriptEditor {...more} testId="script" value={value} keys={['goal', 'pose']} onChange={onChange} />
      </>
    );
  }
  const { unmount } = show(<Field />);
  const field = screen.getByRole('textbox');
  const view = EditorView.findFromDOM(field)!;
  /** Types text at the end of the script. */
  const type = (insert: string) =>
    act(() => {
      const from = view.state.doc.length;
      view.dispatch({
        changes: { from, insert },
        selection: { anchor: from + insert.length },
        userEvent: 'input.type',
      });
    });
  return { onChange, field, view, type, unmount };
}

async function completionsOf(text: string): Promise<string[]> {
  const { view, type, unmount } = open('');
  type(text);
  startCompletion(view);
  await vi.waitUntil(() => completionStatus(view.state) !== 'pending');
  const labels = currentCompletions(view.state).map(({ label }) => label);
  unmount();
  return labels;
}

describe('ScriptEditor', () => {
  it('has the label of a text or an element, and checks no spelling', () => {
    expect(open('x').field).toHaveAccessibleName('While');
    expect(screen.getByTestId('script')).toHaveAttribute('spellcheck', 'false');
  });

  it('is named by another element', () => {
    const { field } = open('x', { labelledBy: 'name' });
    expect(field).toHaveAccessibleName('Named');
    expect(field).not.toHaveAttribute('aria-label');
  });

  it('reports typed text, but not its initial text', () => {
    const { onChange, type, view } = open('x := 1');
    type('0');
    expect(onChange).toHaveBeenCalledExactlyOnceWith('x := 10');
    act(() => setText('y := 2'));
    expect(view.state.doc.toString()).toBe('y := 2');
    expect(onChange).toHaveBeenCalledOnce();
  });

  it('is removed with its field', () => {
    const { unmount } = open('x');
    unmount();
    expect(document.querySelector('.cm-editor')).toBeNull();
  });

  it('offers the names of enums.json', async () => {
    const before = useProjectStore.getState();
    onTestFinished(() => useProjectStore.setState(before, true));
    before.addFile('enums.json', '{"enums": {"Color": {"GREEN": 7}}}');
    expect(await completionsOf('GR')).toEqual(['GREEN']);
  });

  it('offers keys first, then statuses and booleans', async () => {
    const names = await completionsOf('S');
    expect(names).toEqual(expect.arrayContaining(['SUCCESS', 'SKIPPED']));
    expect(await completionsOf('go')).toEqual(['goal']);
    expect(await completionsOf('tr')).toContain('true');
  });

  it('offers all of them on demand, the keys first', async () => {
    const names = await completionsOf('x := ');
    expect(names.slice(0, 2)).toEqual(['goal', 'pose']);
    expect([...names].sort()).toEqual(
      ['goal', 'pose', 'SUCCESS', 'FAILURE', 'RUNNING', 'SKIPPED', 'true', 'false'].sort(),
    );
  });

  it('offers nothing inside of a string, and again after it', async () => {
    expect(await completionsOf("x := 'go")).toEqual([]);
    expect(await completionsOf("x := 'a' .. go")).toEqual(['goal']);
  });

  it.each([
    ["'go", 'string'],
    ['0x1F', 'number'],
    ['1.5e3', 'number'],
    ['true', 'atom'],
    ['SKIPPED', 'atom'],
    ['truely', 'variable'],
    ['@goal', 'variable'],
  ])('colours %s as a %s', (text, kind) => {
    const { field } = open(text);
    const spans = [...field.querySelectorAll('.cm-line span')];
    expect(spans.map(({ textContent }) => textContent)).toEqual([text]);
    const classOf: Record<string, string> = (colours[kind] ??= { name: spans[0]!.className });
    expect(spans[0]!.className).toBe(classOf['name']);
  });

  it('gives each kind its own colour', () => {
    const names = Object.values(colours).map(({ name }) => name);
    expect(new Set(names).size).toBe(4);
  });

  it('marks an error at its place, with a hint', async () => {
    const { view } = open('x := 1 % 2');
    const found: [number, number, string][] = [];
    await vi.waitUntil(() => {
      forEachDiagnostic(view.state, ({ message }, from, to) => found.push([from, to, message]));
      return found.length > 0;
    });
    expect(found[0]?.slice(0, 2)).toEqual([7, 8]);
    expect(found[0]?.[2]).toMatch(/^'%' has no meaning here\nthere is no remainder/);
  });

  it('marks the last letter of a script that ends too early', async () => {
    const { view } = open('x :=');
    const found: [number, number][] = [];
    await vi.waitUntil(() => {
      forEachDiagnostic(view.state, (_, from, to) => found.push([from, to]));
      return found.length > 0;
    });
    expect(found[0]).toEqual([3, 4]);
  });
});

/** The CSS class of each kind of word, in the order of appearance. */
const colours: Record<string, Record<string, string>> = {};
