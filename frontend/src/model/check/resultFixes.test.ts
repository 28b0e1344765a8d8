import { describe, expect, it } from 'vitest';
import { emptyDiagram, type Diagram, type DiagramNode } from '../diagram';
import { edit } from '../edits';
import { resultFixes } from './resultFixes';

const tree = (nodes: Record<string, DiagramNode>): Diagram => ({ ...emptyDiagram('Main'), root: 'r', nodes });
const pair = (type: string): Diagram =>
  tree({ r: { type, children: ['a', 'b'] }, a: { type: 'AlwaysSuccess' }, b: { type: 'AlwaysFailure' } });

/** Returns the tree after the only fix of a finding. */
function fixed(code: string, diagram: Diagram, id: string, port?: string): Diagram {
  const [only, ...others] = resultFixes(code, diagram, id, port);
  expect(others).toEqual([]);
  if (!only) throw new Error(`${code} has no fix.`);
  return edit(diagram, only.does).diagram;
}

describe('fixes of what is known without running', () => {
  it('removes a branch that is never ticked where its parent can do without', () => {
    expect(fixed('BT0117', pair('Sequence'), 'b').nodes['r']?.children).toEqual(['a']);
    expect(resultFixes('BT0114', pair('IfThenElse'), 'b')).toEqual([]);
    expect(resultFixes('BT0117', pair('Parallel'), 'b', 'success_count')).toEqual([]);
  });

  it('moves a child that is never ticked before the one that keeps it from that, first of all', () => {
    const { nodes } = pair('Fallback');
    const fallback = tree({ ...nodes, a: { type: 'AlwaysSuccess', name: 'Turn' } });
    const [move, remove] = resultFixes('BT0114', fallback, 'b');
    expect([move?.key, move?.values, remove?.key]).toEqual([
      'move-before',
      { name: 'Turn' },
      'remove-branch',
    ]);
    expect(edit(fallback, move!.does).diagram.nodes['r']?.children).toEqual(['b', 'a']);
    expect(resultFixes('BT0114', fallback, 'r')).toEqual([]);
  });

  it('removes a condition that is always true', () => {
    const always = tree({ r: { type: 'AlwaysSuccess', conditions: { _skipIf: 'true' } } });
    expect(fixed('BT0117', always, 'r', '_skipIf').nodes['r']?.conditions).toBeUndefined();
  });

  it('changes the type of the parent', () => {
    expect(fixed('BT0118', pair('ReactiveFallback'), 'a').nodes['r']?.type).toBe('ReactiveSequence');
    expect(fixed('BT0121', pair('ReactiveFallback'), 'b').nodes['r']?.type).toBe('Fallback');
    expect(resultFixes('BT0121', pair('Sequence'), 'b')).toEqual([]);
    expect(resultFixes('BT0118', pair('Fallback'), 'r')).toEqual([]);
  });

  it('takes a decorator away that changes nothing, or two that undo each other', () => {
    const two = tree({
      r: { type: 'Inverter', children: ['i'] },
      i: { type: 'Inverter', children: ['a'] },
      a: { type: 'AlwaysSuccess' },
    });
    expect(fixed('BT0119', two, 'r')).toMatchObject({ root: 'i' });
    const plain = fixed('BT0124', two, 'r');
    expect([plain.root, Object.keys(plain.nodes)]).toEqual(['a', ['a']]);
  });

  it('puts a delay into an endless loop', () => {
    const loop = tree({ r: { type: 'Repeat', children: ['a'] }, a: { type: 'AlwaysSuccess' } });
    const { nodes } = fixed('BT0120', loop, 'r');
    const delay = nodes['r']?.children?.[0] ?? '';
    expect(nodes[delay]).toEqual({ type: 'Delay', ports: { delay_msec: '100' }, children: ['a'] });
  });

  it('knows no fix of other findings', () => {
    expect(resultFixes('BT0405', pair('Sequence'), 'a')).toEqual([]);
    expect(resultFixes('BT0120', tree({ r: { type: 'Repeat' } }), 'r')).toEqual([]);
  });
});
