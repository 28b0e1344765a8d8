import { describe, expect, it } from 'vitest';
import { emptyDiagram, type Diagram } from '@/model/diagram';
import { inOwnWords, problemsOf, whileEditing } from './problems';
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

  it('uses the translated text of the editor where it has the same finding', () => {
    expect(inOwnWords(item, diagram, vocabulary)).toMatchObject({
      source: 'editor',
      kind: 'unknown-type',
      values: { type: 'Nobody' },
    });
  });

  it('keeps the text of the server where the editor has no such finding', () => {
    const alone = { source: 'server', message: item.message, hint: item.hint };
    expect(inOwnWords({ ...item, code: 'BT0601' }, diagram, vocabulary)).toMatchObject(alone);
    expect(inOwnWords(item, undefined, vocabulary)).toMatchObject(alone);
  });
});

describe('an empty tree', () => {
  const empty = { code: 'BT0101', severity: 'error', message: 'Nothing.', tree: 'Main' } as const;
  const { vocabulary } = useProjectStore.getState();
  const diagram = emptyDiagram('Main');

  it('is no error while it is edited, and other findings stay what they are', () => {
    const other = { ...empty, code: 'BT0102' };
    expect(whileEditing([empty, other]).map(({ severity }) => severity)).toEqual(['note', 'error']);
    expect(problemsOf(diagram, vocabulary, []).map(({ severity }) => severity)).toEqual(['note']);
  });

  it('is the error that a run says it is', () => {
    expect(inOwnWords(empty, diagram, vocabulary)).toMatchObject({ kind: 'empty-tree', severity: 'error' });
  });
});
