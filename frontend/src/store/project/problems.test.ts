import { describe, expect, it } from 'vitest';
import { emptyDiagram, type Diagram } from '@/model/diagram';
import { isSilenced, problemsOf, whileEditing } from './problems';
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

  it('is silenced at its block with a reason, unless it is an error', () => {
    const odd = { ...item, code: 'BT0119', severity: 'warning' as const, path: [] };
    const silenced = (reason: string): Diagram => ({
      ...diagram,
      nodes: { n1: { type: 'Sleep', silenced: { BT0119: reason, BT0201: reason } } },
    });
    const shown = (given: Diagram, ...rest: (typeof odd)[]) =>
      problemsOf(given, vocabulary, rest).filter(({ source }) => source === 'server');
    expect(shown(silenced('later'), odd)).toEqual([]);
    expect(shown(silenced(' '), odd)).toHaveLength(1);
    expect(isSilenced(silenced('later'), { code: 'BT0119', severity: 'error', node: 'n1' })).toBe(false);
    expect(isSilenced(silenced('later'), { code: 'BT0119', severity: 'note', node: null })).toBe(false);
  });

  it('keeps the path of its reason', () => {
    const step = { tree: 'Main', node: 'n1', label: 'Nobody', results: ['SUCCESS'], role: '', what: '' };
    const odd = { ...item, code: 'BT0119', path: [step] };
    expect(problemsOf(diagram, vocabulary, [odd])[1]).toMatchObject({ path: [step] });
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
