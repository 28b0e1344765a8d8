import { describe, expect, it } from 'vitest';
import { emptyDiagram, type Diagram, type DiagramNode } from './diagram';
import { edit, setPort } from './edits';
import { differInPortsOnly, portChanges, withPorts } from './portChanges';

const tree = (id: string, nodes: Record<string, DiagramNode>): Diagram => ({ ...emptyDiagram(id), nodes });
const before = {
  Main: tree('Main', { a: { type: 'Go', ports: { speed: '0.3' } }, b: { type: 'Turn' } }),
  Part: tree('Part', { a: { type: 'Go' } }),
};
const set = (id: string, name: string, value: string | null) => ({
  ...before,
  Main: edit(before.Main, setPort(id, name, value)).diagram,
});

describe('changed ports', () => {
  it('are those with another text, a new one, or none any more', () => {
    const change = { tree: 'Main', node: 'a', port: 'speed' };
    expect(portChanges(before, set('a', 'speed', '0.5'))).toEqual([
      { ...change, before: '0.3', value: '0.5' },
    ]);
    expect(portChanges(before, set('a', 'speed', null))).toEqual([{ ...change, before: '0.3', value: null }]);
    expect(portChanges(before, set('b', 'angle', '90'))).toEqual([
      { tree: 'Main', node: 'b', port: 'angle', before: null, value: '90' },
    ]);
    expect(portChanges(before, { ...before })).toEqual([]);
  });

  it('are not those of a new block, or of one with another type', () => {
    const main = tree('Main', {
      a: { type: 'Stop', ports: { speed: '1' } },
      b: { type: 'Turn' },
      c: { type: 'Go', ports: { speed: '1' } },
    });
    expect(portChanges(before, { ...before, Main: main, New: main })).toEqual([]);
  });

  it('make the later state of the earlier one', () => {
    for (const now of [set('a', 'speed', '0.5'), set('b', 'angle', '90')]) {
      expect(portChanges(withPorts(before, portChanges(before, now)), now)).toEqual([]);
    }
    expect(withPorts(before, [{ tree: 'Gone', node: 'a', port: 'x', before: null, value: '1' }])).toBe(
      before,
    );
  });
});

describe('states that differ in ports only', () => {
  it('have the same trees and blocks', () => {
    expect(differInPortsOnly(before, before)).toBe(true);
    expect(differInPortsOnly(before, set('a', 'speed', '0.5'))).toBe(true);
    expect(differInPortsOnly(before, set('b', 'angle', '90'))).toBe(true);
  });

  it.each([
    ['a tree less', { Main: before.Main }],
    ['another layout', { ...before, Main: { ...before.Main, layout: 'horizontal' as const } }],
    ['another block', { ...before, Part: tree('Part', { b: { type: 'Go' } }) }],
    ['a block more', { ...before, Part: tree('Part', { ...before.Part.nodes, b: { type: 'Go' } }) }],
    ['another name', { ...before, Part: tree('Part', { a: { type: 'Go', name: 'x' } }) }],
  ])('do not have %s', (_, now) => {
    expect(differInPortsOnly(before, now)).toBe(false);
  });
});
