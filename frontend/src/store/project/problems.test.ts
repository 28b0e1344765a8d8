import { describe, expect, it } from 'vitest';
import { emptyDiagram, type Diagram } from '@/model/diagram';
import { problemsOf, whileEditing } from './problems';
import { useProjectStore } from '.';

describe('a finding of the server', () => {
  const { vocabulary } = useProjectStore.getState();
  const node = { id: 'n1', type: 'Nobody', name: '', children: [], ports: {} };
  const diagram = { ...emptyDiagram('Main'), root: 'n1', nodes: { n1: node } } as unknown as Diagram;
  const item = {
    code: 'BT0102',
    severity: 'error' as const,
    message: 'There is no node or action “Nobody”.',
    hint: 'Write it.',
    tree: 'Main',
    node: 'n1',
  };

  it('is shown once, in the translated text of the editor if it has the same', () => {
    expect(problemsOf(diagram, vocabulary, [item])).toEqual([
      expect.objectContaining({ source: 'editor', kind: 'unknown-type', values: { type: 'Nobody' } }),
    ]);
  });

  it('keeps the text and the line of the server if the editor has no such finding', () => {
    const other = { ...item, code: 'BT0601', file: 'actions/Nobody.py', line: 3 };
    const { message, hint, file, line } = other;
    expect(problemsOf(diagram, vocabulary, [other])[1]).toMatchObject({
      source: 'server',
      message,
      hint,
      file,
      line,
    });
  });

  it('is removed with its block', () => {
    expect(problemsOf(diagram, vocabulary, [{ ...item, node: 'gone' }])).toHaveLength(1);
  });
});

describe('an empty tree', () => {
  const empty = { code: 'BT0101', severity: 'error', message: 'Nothing.', tree: 'Main' } as const;
  const { vocabulary } = useProjectStore.getState();
  const diagram = emptyDiagram('Main');

  it('is no error while it is edited, and other findings stay unchanged', () => {
    const other = { ...empty, code: 'BT0102' };
    expect(whileEditing([empty, other]).map(({ severity }) => severity)).toEqual(['note', 'error']);
    expect(problemsOf(diagram, vocabulary, []).map(({ severity }) => severity)).toEqual(['note']);
  });

  it('is an error if a run reports it', () => {
    const [found, ...more] = problemsOf(diagram, { ...vocabulary, reachable: new Set(['Main']) }, [empty]);
    expect(found).toMatchObject({ kind: 'empty-tree', severity: 'error' });
    expect(more).toEqual([]);
  });
});
