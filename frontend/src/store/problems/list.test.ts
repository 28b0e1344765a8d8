import { describe, expect, it } from 'vitest';
import type { Diagnostic } from '@/api/types';
import type { Fault, TopicMismatch } from '@/generated/messages';
import { emptyDiagram, type Diagram, type DiagramNode } from '@/model/diagram';
import type { CodeFinding } from '@/store/language';
import { useProjectStore } from '@/store/project';
import { countProblems, listProblems, worstByFile, type ProblemSources } from './list';

const { vocabulary } = useProjectStore.getState();
const GO = 'actions/Go.py';

const tree = (id: string, node: DiagramNode): Diagram => ({
  ...emptyDiagram(id),
  root: 'n1',
  nodes: { n1: node },
});

const served = (message: string, severity: CodeFinding['severity'], line = 0): CodeFinding => ({
  from: { line, character: 0 },
  to: { line, character: 1 },
  severity,
  message,
  source: 'ty unresolved-reference',
});

const fault = (more: Partial<Fault> = {}): Fault => ({
  kind: 'exception',
  message: 'NameError',
  hint: '',
  node_id: 'n1',
  tree_id: 'Main',
  node_path: '',
  file: GO,
  line: 4,
  traceback: '',
  ...more,
});

const listed = (more: Partial<ProblemSources>) =>
  listProblems({
    files: { [GO]: {}, 'a.json': {}, 'nodes/tones.py': {} },
    diagrams: { Main: tree('Main', { type: 'AlwaysSuccess' }) },
    vocabulary,
    diagnostics: [],
    robots: null,
    served: {},
    linted: {},
    errors: {},
    faults: [],
    mismatches: [],
    launchNodes: [],
    ...more,
  });
const shown = (more: Partial<ProblemSources>) =>
  listed(more).map(({ severity, code, file, line, tree: id, node }) => [
    severity,
    code,
    file ?? id,
    line ?? node,
  ]);

describe('the list', () => {
  it('is empty without findings', () => {
    expect(listed({})).toEqual([]);
  });

  it('has the checks of each tree at once, without a save', () => {
    const diagrams = {
      Main: tree('Main', { type: 'AlwaysSuccess' }),
      Other: tree('Other', { type: 'Nobody' }),
    };
    expect(shown({ diagrams })).toEqual([['error', 'BT0102', 'Other', 'n1']]);
  });

  it('has topics whose ends do not match, with the names and the line that has the topic', () => {
    const mismatch: TopicMismatch = {
      topic: '/scan',
      publisher: '/world',
      subscriber: '/bt_application',
      reason: 'type',
      message: 'Nothing arrives.',
      hint: '',
      code: 'type',
      values: { published: 'a', wanted: 'b' },
      resolved: false,
    };
    const [row] = listed({ mismatches: [mismatch], files: { [GO]: { text: '\nsub(Scan, "scan")' } } });
    expect(row).toMatchObject({ severity: 'error', code: 'type', topic: '/scan', file: GO, line: 2 });
    expect(row?.problem).toMatchObject({
      source: 'topic',
      values: { topic: '/scan', publisher: '/world', wanted: 'b' },
    });
    expect(shown({ mismatches: [mismatch] })).toEqual([['error', 'type', null, null]]);
    const missing: TopicMismatch = { ...mismatch, reason: 'nobody', code: 'unpublished' };
    expect(shown({ mismatches: [missing] })).toEqual([['warning', 'unpublished', null, null]]);
  });

  it('has a finding of a save once: in the newer version of the editor, the language server or ruff', () => {
    const diagnostics: Diagnostic[] = [
      { code: 'BT0601', severity: 'error', message: 'syntax', file: GO, line: 2 },
      { code: 'BT0602', severity: 'error', message: 'no class', file: GO },
    ];
    const syntax = { ...served('syntax', 'error', 1), source: 'ty invalid-syntax' };
    expect(shown({ diagnostics })).toEqual([
      ['error', 'BT0601', GO, 2],
      ['error', 'BT0602', GO, null],
    ]);
    expect(shown({ diagnostics, served: { [GO]: [syntax] } })).toEqual([
      ['error', 'BT0602', GO, null],
      ['error', 'ty invalid-syntax', GO, 2],
    ]);
  });

  it('has the findings in any text of the project, and none of deleted files', () => {
    const unused = {
      code: 'F401',
      severity: 'warning' as const,
      message: 'unused',
      start: { line: 3, column: 1 },
      end: { line: 3, column: 2 },
      fix: null,
    };
    expect(
      shown({
        served: { 'nodes/tones.py': [served('no name', 'error', 6)], 'gone.py': [served('x', 'error')] },
        linted: { 'nodes/tones.py': { text: '', findings: [unused] } },
        errors: { 'a.json': { text: '', errors: [{ offset: 9, line: 2, message: 'not JSON' }] } },
      }),
    ).toEqual([
      ['error', 'ty unresolved-reference', 'nodes/tones.py', 7],
      ['error', '', 'a.json', 2],
      ['warning', 'ruff F401', 'nodes/tones.py', 3],
    ]);
  });

  it('starts with the fault of the run, at its line if that is in the project', () => {
    const diagnostics: Diagnostic[] = [{ code: 'X', severity: 'error', message: '' }];
    expect(shown({ diagnostics, faults: [fault()] })[0]).toEqual(['error', 'exception', GO, 4]);
    expect(shown({ faults: [fault({ file: '/usr/lib/x.py' })] })[0]).toEqual([
      'error',
      'exception',
      'Main',
      'n1',
    ]);
  });
});

it('marks the files with errors and warnings: trees by theirs, a fault in both', () => {
  const rows = listed({
    faults: [fault()],
    served: { 'nodes/tones.py': [served('', 'warning'), served('', 'info')] },
  });
  expect([...worstByFile(rows)]).toEqual([
    [GO, 'error'],
    ['trees/Main.json', 'error'],
    ['nodes/tones.py', 'warning'],
  ]);
  expect(countProblems(rows)).toEqual({ errors: 1, warnings: 1 });
});
