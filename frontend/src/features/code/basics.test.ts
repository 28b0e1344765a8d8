import { EditorState } from '@codemirror/state';
import { EditorView, runScopeHandlers } from '@codemirror/view';
import { beforeEach, describe, expect, it, onTestFinished, vi } from 'vitest';
import { useProjectStore } from '@/store/project';
import { openProject } from '../../../harness/testing';
import { basics } from './basics';

function open(keys: Parameters<typeof basics>[1] = []) {
  const parent = document.body.appendChild(document.createElement('div'));
  const view = new EditorView({
    parent,
    state: EditorState.create({ doc: 'one\ntwo', extensions: basics('Source', keys) }),
  });
  onTestFinished(() => {
    view.destroy();
    parent.remove();
    localStorage.clear();
  });
  return view;
}

const press = (view: EditorView, key: string, keyCode: number, more: KeyboardEventInit = {}) =>
  runScopeHandlers(
    view,
    new KeyboardEvent('keydown', { key, keyCode, ...more } as KeyboardEventInit),
    'editor',
  );

beforeEach(() => openProject({}));

describe('basics', () => {
  it('names the editor, and makes it reachable by keyboard', () => {
    const { contentDOM, dom } = open();
    expect(contentDOM.getAttribute('aria-label')).toBe('Source');
    expect(contentDOM.getAttribute('tabindex')).toBe('0');
    expect(
      [...dom.querySelectorAll('.cm-lineNumbers .cm-gutterElement')].map(({ textContent }) => textContent),
    ).toContain('2');
  });

  it('is read-only for viewers', () => {
    expect(open().state.readOnly).toBe(false);
    useProjectStore.setState({ role: 'viewer' });
    expect(open().state.readOnly).toBe(true);
  });

  it('indents by Tab, and undoes the indentation', () => {
    const view = open();
    press(view, 'Tab', 9);
    expect(view.state.doc.toString()).toBe('  one\ntwo');
    press(view, 'z', 90, { ctrlKey: true });
    expect(view.state.doc.toString()).toBe('one\ntwo');
  });

  it('shows the search at the top', () => {
    const view = open();
    press(view, 'f', 70, { ctrlKey: true });
    expect(view.dom.querySelector('.cm-panels-top .cm-search')).not.toBeNull();
  });

  it('changes the font size', () => {
    const size = () => document.documentElement.style.getPropertyValue('--bts-code-size');
    press(open(), '0', 48, { ctrlKey: true });
    expect(size()).toBe('13px');
    press(open(), '=', 187, { ctrlKey: true });
    expect(size()).toBe('14px');
  });

  it('prefers the given keys', () => {
    const run = vi.fn(() => true);
    const view = open([{ key: 'Tab', run }]);
    press(view, 'Tab', 9);
    expect(run).toHaveBeenCalledOnce();
    expect(view.state.doc.toString()).toBe('one\ntwo');
  });
});
