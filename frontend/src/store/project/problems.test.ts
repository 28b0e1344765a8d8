import { describe, expect, it } from 'vitest';
import { emptyDiagram, type Diagram } from '@/model/diagram';
import { problemsOf } from './problems';
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

  it('is shown once, in the translated text of the editor, where that finds the same', () => {
    expect(problemsOf(diagram, vocabulary, [item])).toEqual([
      expect.objectContaining({ source: 'editor', kind: 'unknown-type', values: { type: 'Nobody' } }),
    ]);
  });

  it('keeps the text and the line of the server where the editor has no such finding', () => {
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

  it('leaves with its block', () => {
    expect(problemsOf(diagram, vocabulary, [{ ...item, node: 'gone' }])).toHaveLength(1);
  });
});
