import { readFileSync } from 'node:fs';
import { describe, expect, it } from 'vitest';
import { DiagramError, parseDiagram, serializeDiagram } from './serialize';

interface Repair {
  readonly given: {
    readonly root: string;
    readonly drafts: string[];
    readonly nodes: Record<string, string[]>;
  };
  readonly root: string | null;
  readonly drafts: string[];
  readonly children: Record<string, string[]>;
}

const repairs = JSON.parse(readFileSync('../tests/shared/repairs.json', 'utf8')) as Repair[];
const base = {
  format: 'bt-studio/diagram',
  version: 1,
  id: 'T',
  root: null,
  nodes: {},
  drafts: [],
  layout: 'vertical',
};

describe('parseDiagram', () => {
  it.each([
    ['not JSON', '{', /not JSON/],
    ['a list', [], /object/],
    ['another format', { ...base, format: 'x' }, /format/],
    ['a newer version', { ...base, version: 9 }, /newer/],
    ['a node without a type', { ...base, nodes: { a: {} } }, /nodes\.a/],
    ['ports that are no texts', { ...base, nodes: { a: { type: 'A', ports: { p: {} } } } }, /ports\.p/],
  ])('refuses %s with the place', (_what, value, message) => {
    expect(() => parseDiagram(value)).toThrow(DiagramError);
    expect(() => parseDiagram(value)).toThrow(message);
  });

  it('repairs dangling links, second parents, cycles and lost pieces', () => {
    const diagram = parseDiagram({
      ...base,
      root: 'r',
      nodes: {
        r: { type: 'Sequence', children: ['a', 'gone', 'a'] },
        a: { type: 'Sequence', children: ['r'] },
        x: { type: 'Inverter', children: ['y'] },
        y: { type: 'Inverter', children: ['x'] },
        lost: { type: 'Turn' },
      },
    });
    expect(diagram.nodes['r']?.children).toEqual(['a']);
    expect(diagram.nodes['a']?.children).toEqual([]);
    expect(diagram.drafts).toEqual(['x', 'lost']);
  });

  it.each(repairs.map((each) => [JSON.stringify(each), each] as const))(
    'repairs %s as the translator does',
    (_what, { given, root, drafts, children }) => {
      const nodes = Object.fromEntries(
        Object.entries(given.nodes).map(([id, below]) => [id, { type: 'Sequence', children: below }]),
      );
      const diagram = parseDiagram({ ...base, ...given, nodes });
      expect(diagram.root).toBe(root);
      expect(diagram.drafts).toEqual(drafts);
      const found = Object.entries(diagram.nodes).map(([id, node]) => [id, node.children ?? []]);
      expect(Object.fromEntries(found)).toEqual(children);
    },
  );

  it('keeps unknown keys', () => {
    const text = serializeDiagram(
      parseDiagram({ ...base, nodes: { a: { type: 'A', future: [1] } }, drafts: ['a'], model: { x: 1 } }),
    );
    expect(JSON.parse(text)).toMatchObject({ nodes: { a: { future: [1] } }, model: { x: 1 } });
  });
});

describe('serializeDiagram', () => {
  it.each(['laser_bump_and_go', 'visual_follow_person'])(
    'reproduces the example %s byte for byte',
    (name) => {
      const text = readFileSync(`../examples/${name}/trees/MainTree.json`, 'utf8');
      expect(serializeDiagram(parseDiagram(text))).toBe(text);
    },
  );
});

describe('silenced findings', () => {
  const silent = { type: 'Sleep', silenced: { BT0119: 'later' } };

  it('make a file of version 2, which is read again', () => {
    const text = serializeDiagram(parseDiagram({ ...base, nodes: { a: silent }, root: 'a' }));
    expect(JSON.parse(text)).toMatchObject({ version: 2, nodes: { a: silent } });
    expect(serializeDiagram(parseDiagram(text))).toBe(text);
  });

  it('leave other files as they are', () => {
    const read = parseDiagram({ ...base, version: 2, nodes: { a: { type: 'Sleep' } }, root: 'a' });
    expect(JSON.parse(serializeDiagram(read))).toMatchObject({ version: 1 });
  });
});
