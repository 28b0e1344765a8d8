import { EditorView } from '@codemirror/view';
import { beforeEach, describe, expect, it, onTestFinished, vi } from 'vitest';
import { registerCommands } from '@/commands/registry';
import { fakeServer } from '../../../../harness/testing';
import { saveKeys } from './keys';
import { setFormatsOnSave } from './ruff';

const save = vi.fn();
let requests: ReturnType<typeof fakeServer>['requests'];

beforeEach(() => {
  save.mockClear();
  ({ requests } = fakeServer({ 'POST /python/format': { source: 'x = 1\n', findings: [] } }));
  onTestFinished(registerCommands([{ id: 'project.save', group: 'project', labelKey: '', run: save }]));
  onTestFinished(() => localStorage.clear());
});

const press = (key: string) => {
  const view = new EditorView({ doc: 'x=1\n' });
  const binding = saveKeys('a.py').find((each) => each.key === key);
  expect(binding?.preventDefault).toBe(true);
  expect(binding?.run?.(view)).toBe(true);
  return view;
};

describe('saveKeys', () => {
  it('are absent for files other than Python', () => {
    expect(saveKeys('a.md')).toEqual([]);
  });

  it('format without saving', async () => {
    const view = press('Shift-Alt-f');
    await expect.poll(() => view.state.doc.toString()).toBe('x = 1\n');
    expect(save).not.toHaveBeenCalled();
  });

  it('save the formatted text', async () => {
    let saved = '';
    const view = press('Mod-s');
    save.mockImplementation(() => (saved = view.state.doc.toString()));
    await expect.poll(() => saved).toBe('x = 1\n');
  });

  it('save only, if formatting is switched off', async () => {
    setFormatsOnSave(false);
    const view = press('Mod-s');
    await expect.poll(() => save.mock.calls.length).toBe(1);
    expect(requests).toEqual([]);
    expect(view.state.doc.toString()).toBe('x=1\n');
  });
});
