import { describe, expect, it } from 'vitest';
import { allChoices, matchScore, searchChoices, suits } from './choices';
import { emptyDiagram } from './diagram';
import { findNodes } from './find';
import { outlineRows } from './outline';
import { parseDiagram } from './serialize';
import { vocabulary } from './testing';

const diagram = parseDiagram({
  format: 'bt-studio/diagram',
  version: 1,
  id: 'MainTree',
  root: 'r',
  nodes: {
    r: { type: 'Sequence', name: 'patrol', children: ['a', 'b'] },
    a: { type: 'Turn', ports: { ang_speed: '{speed}' }, comment: 'slowly' },
    b: { type: 'Inverter', children: ['c'], collapsed: true },
    c: { type: 'Turn' },
    d: { type: 'Free' },
  },
});
const labels = (search: string) =>
  searchChoices(allChoices(diagram, vocabulary), search).map((each) => each.label);

describe('choices', () => {
  it("list the user's own actions first, and matches in names before those in descriptions", () => {
    expect(labels('').slice(0, 2)).toEqual(['Turn', 'Free']);
    expect(labels('seq').slice(0, 1)).toEqual(['Sequence']);
    expect(labels('rus')[0]).toBe('RetryUntilSuccessful');
    expect(labels('qqq')).toEqual([]);
  });
  it('are found by what the page says of them', () => {
    const found = searchChoices(allChoices(diagram, vocabulary), 'orden', ({ spec }) =>
      spec.type === 'Fallback' ? 'Ejecuta sus hijos en orden.' : '',
    );
    expect(found.map(({ label }) => label)).toEqual(['Fallback']);
  });
  it('leave out trees that would contain themselves', () => {
    expect(labels('MainTree')).not.toContain('MainTree');
  });
  it('are those that can have the wrapped blocks, or the present children', () => {
    const fit = (purpose: Parameters<typeof suits>[2]) =>
      allChoices(diagram, vocabulary)
        .filter((choice) => suits(choice, diagram, purpose))
        .map((choice) => choice.label);
    expect(fit({ for: 'wrap', count: 1 })).toContain('Inverter');
    expect(fit({ for: 'wrap', count: 2 })).not.toContain('Inverter');
    expect(fit({ for: 'morph', node: 'r' })).not.toContain('Turn');
    expect(fit({ for: 'add' })).toContain('Turn');
  });
  it('end with the offered actions, which a search finds by a part of the name', () => {
    const turn = vocabulary.specs.get('Turn');
    const offered = [{ ...turn!, type: 'TurnBack', source: 'offered' as const }];
    const found = (search: string) =>
      searchChoices(allChoices(diagram, vocabulary, offered), search).map(({ label }) => label);
    expect(found('tur').slice(0, 2)).toEqual(['Turn', 'TurnBack']);
    expect(found('tbk')).not.toContain('TurnBack');
    expect(found('')).not.toContain('TurnBack');
    const all = allChoices(diagram, vocabulary, [turn!]).filter(({ label }) => label === 'Turn');
    expect(all).toHaveLength(1);
  });
  it('score exact names highest', () => {
    expect(matchScore('Turn', 'turn')).toBeGreaterThan(matchScore('TurnAround', 'turn'));
    expect(matchScore('Turn', 'x')).toBe(0);
  });
});

describe('findNodes', () => {
  it.each([
    ['patrol', ['r']],
    ['turn', ['a', 'c']],
    ['{speed', ['a']],
    ['slow', ['a']],
    [' ', []],
  ])('finds %j', (text, expected) => {
    expect(findNodes(diagram, text)).toEqual(expected);
  });
});

describe('outlineRows', () => {
  it('follow execution order, leave out folded blocks, and end with drafts', () => {
    const rows = outlineRows(diagram).map(({ id, depth, isFolded, isDraft }) => [
      id,
      depth,
      isFolded,
      isDraft,
    ]);
    expect(rows).toEqual([
      ['r', 0, false, false],
      ['a', 1, false, false],
      ['b', 1, true, false],
      ['d', 0, false, true],
    ]);
    expect(outlineRows(emptyDiagram('T'))).toEqual([]);
  });
});
