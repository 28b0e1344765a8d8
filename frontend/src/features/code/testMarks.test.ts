import { Text } from '@codemirror/state';
import type { EditorView } from '@codemirror/view';
import { expect, it } from 'vitest';
import type { TestReport } from '@/api/types';
import '@/i18n';
import { watchNavigation } from '../../../harness/testing';
import { testMarks } from './testMarks';

const doc = Text.of(['tests:', '  - name: x', '    expect: [{at: 1}]']);
const failure = { message: 'wanted A, got B', line: 3, node: 'Turn', tree: 'Main', node_id: 'a' };
const report = {
  tests: [
    { file: 'tests/a.test.yaml', failures: [failure, { ...failure, node: '', node_id: '' }] },
    { file: 'tests/b.test.yaml', failures: [failure] },
  ],
  problems: [
    { code: 'TG901', severity: 'error', message: 'No.', hint: '', file: 'tests/a.test.yaml', line: 2 },
  ],
} as unknown as TestReport;

it('marks the lines of the file that failed, and leads to the blocks', () => {
  const { openTree } = watchNavigation();
  const marks = testMarks(doc, 'tests/a.test.yaml', report);
  expect(marks.map(({ from, message, source }) => [doc.lineAt(from).number, message, source])).toEqual([
    [3, 'Turn: wanted A, got B', undefined],
    [3, 'wanted A, got B', undefined],
    [2, 'No.', 'TG901'],
  ]);
  const [first, second] = marks;
  expect(second?.actions).toBeUndefined();
  first?.actions?.[0]?.apply(null as unknown as EditorView, 0, 0);
  expect(openTree).toHaveBeenCalledExactlyOnceWith('Main');
});

it('marks nothing without a report', () => {
  expect(testMarks(doc, 'tests/a.test.yaml', null)).toEqual([]);
});
