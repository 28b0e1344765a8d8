import { Text } from '@codemirror/state';
import { MantineProvider } from '@mantine/core';
import { render, screen } from '@testing-library/react';
import userEvent from '@testing-library/user-event';
import { beforeEach, describe, expect, it, vi } from 'vitest';
import '@/i18n';
import type { Diagnostic } from '@/api/types';
import { useProjectStore } from '@/store/project';
import { setNavigator } from '@/store/project/navigation';
import { marksFor } from './diagnostics';
import { FileDialog } from './FileDialog';
import { nameProblem } from './names';
import { openNewFile, useFileDialog } from '@/store/dialogs/files';
import { textErrors, textMarks } from './textErrors';
import { ACTION_TEMPLATES, actionSource } from './templates';

const doc = Text.of(['class Go:', '    def update(self)', '        return 1']);
const PATH = 'actions/Go.py';

const diagnostic = (more: Partial<Diagnostic>): Diagnostic => ({
  code: 'BT0301',
  severity: 'error',
  message: 'expected ":"',
  ...more,
});

describe('marksFor', () => {
  it('marks the word at a column', () => {
    const [mark] = marksFor(doc, PATH, [diagnostic({ file: PATH, line: 2, column: 5 })], []);
    expect(doc.sliceString(mark!.from, mark!.to)).toBe('def');
  });

  it('marks the whole line where there is no column, without its indent', () => {
    const [mark] = marksFor(doc, PATH, [diagnostic({ file: PATH, line: 3 })], []);
    expect(doc.sliceString(mark!.from, mark!.to)).toBe('return 1');
  });

  it('survives lines that are not there any more, and leaves other files out', () => {
    const items = [diagnostic({ file: PATH, line: 99 }), diagnostic({ file: 'actions/Other.py', line: 1 })];
    expect(marksFor(doc, PATH, items, [])).toHaveLength(1);
  });

  it('marks the line that raised', () => {
    const fault = {
      kind: 'exception' as const,
      message: 'ZeroDivisionError: division by zero',
      hint: '',
      node_id: 'n1',
      tree_id: 'MainTree',
      node_path: 'go',
      file: PATH,
      line: 3,
      traceback: '',
    };
    const [mark] = marksFor(doc, PATH, [], [fault]);
    expect(mark).toMatchObject({ severity: 'error', message: fault.message });
  });
});

describe('nameProblem', () => {
  const taken = { paths: ['actions/Turn.py', 'trees/MainTree.json'], types: new Set(['Sequence']) };
  it.each([
    ['action', 'FollowWall', null],
    ['action', 'turn', 'taken'],
    ['action', 'Sequence', 'builtin'],
    ['action', '3D', 'notIdentifier'],
    ['action', 'class', 'notIdentifier'],
    ['tree', 'MainTree', 'taken'],
    ['file', '../secret', 'notPath'],
    ['file', 'assets/map.yaml', null],
    ['tree', ' ', 'empty'],
  ] as const)('%s %s: %s', (kind, name, problem) => {
    expect(nameProblem(kind, name, taken)).toBe(problem);
  });
});

describe('actionSource', () => {
  it('names the class as its file', () => {
    for (const kind of ACTION_TEMPLATES) {
      const base = { control: 'ControlNode', decorator: 'DecoratorNode' }[kind as string];
      const line = `class FollowWall(${base ?? 'py_trees.behaviour.Behaviour'}):`;
      expect(actionSource('FollowWall', kind)).toContain(line);
    }
  });
});

describe('textErrors', () => {
  it.each([
    ['a.json', '{"a": 1}', null, ''],
    ['a.json', '{"a": 1,}', 8, 'This is not valid JSON'],
    ['a.json', '{"a": 01}', 7, 'This is not valid JSON'],
    ['a.json', '{"a": [1, 2', 11, 'This is not valid JSON'],
    ['a.json', '\n', 1, 'The file is empty'],
    ['a.yaml', 'a: 1\nb: [1, 2\n', 14, 'This is not YAML'],
    ['a.yml', 'a: 1\na: 2\n', 5, 'unique'],
    ['a.launch', '<launch>\n<node/>\n</lunch>', 17, '</lunch>'],
    ['a.md', '{', null, ''],
    ['a.json', `[${'1,'.repeat(300_000)}`, null, ''],
  ] as const)('%s', (path, text, offset, words) => {
    const [error] = textErrors(path, text);
    expect(error?.offset ?? null).toBe(offset);
    expect(error?.message ?? '').toContain(words);
  });

  it('are marked while they are about the text that is there', () => {
    const text = Text.of(['{"a": oh}']);
    const errors = textErrors('a.json', text.toString());
    const [mark] = textMarks(text, { doc: text, errors });
    expect(text.sliceString(mark!.from, mark!.to)).toBe('oh');
    expect(textMarks(Text.of(['{}']), { doc: text, errors })).toEqual([]);
  });
});

describe('FileDialog', () => {
  beforeEach(() => {
    useFileDialog.setState({ dialog: null });
    useProjectStore.setState({ files: {}, diagrams: {} });
  });

  it('makes an action from a template and opens it', async () => {
    const openFile = vi.fn();
    setNavigator({ openTree: vi.fn(), aimAt: vi.fn(), renamed: vi.fn(), openFile });
    openNewFile('action');
    render(
      <MantineProvider env="test">
        <FileDialog />
      </MantineProvider>,
    );
    await userEvent.type(screen.getByLabelText('Name of the class and its file'), 'Stop');
    await userEvent.click(screen.getByRole('radio', { name: /Condition/ }));
    await userEvent.click(screen.getByRole('button', { name: 'Create' }));
    expect(useProjectStore.getState().currentText('actions/Stop.py')).toContain('NODE_KIND = "Condition"');
    expect(openFile).toHaveBeenCalledWith('actions/Stop.py', undefined);
  });
});
