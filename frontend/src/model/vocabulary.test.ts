import catalog from '@catalog';
import { describe, expect, it } from 'vitest';
import { emptyDiagram, type Diagram } from './diagram';
import { canMorph, canWrapIn, hasRoom } from './rules';
import { makeVocabulary, readCatalog, type ActionDescription } from './vocabulary';

const own = (name: string, kind: string, children?: ActionDescription['children']): ActionDescription => ({
  ...{ name, kind, open: false, ports: [], doc: `Says what ${name} does.` },
  ...(children ? { children } : {}),
});
const vocabulary = makeVocabulary(readCatalog(catalog), [
  own('Own', 'control', { min: 2, max: 3 }),
  own('AnyNumber', 'control', { min: 1, max: null }),
  own('Around', 'decorator', { min: 1, max: 1 }),
  own('New', 'Control'),
  own('NewAround', 'Decorator'),
  own('Act', 'SyncAction'),
  own('See', 'Condition'),
]);
const spec = (type: string) => {
  const found = vocabulary.specs.get(type);
  if (!found) throw new Error(`no ${type}`);
  return found;
};

describe('the nodes of a project', () => {
  it.each([
    ['Own', 'control', 2, 3],
    ['AnyNumber', 'control', 1, Infinity],
    ['Around', 'decorator', 1, 1],
    ['New', 'control', 1, Infinity],
    ['NewAround', 'decorator', 1, 1],
    ['Act', 'action', 0, 0],
    ['See', 'condition', 0, 0],
  ])('%s is of the family %s, with %d to %d children', (type, family, min, max) => {
    expect(spec(type)).toMatchObject({ family, minChildren: min, maxChildren: max, source: 'action' });
    expect(spec(type).summary).toBe(`Says what ${type} does.`);
  });

  it('can be wrapped, morphed and added like built-in nodes', () => {
    const nodes = { r: { type: 'Own', children: ['a', 'b'] }, a: { type: 'Act' }, b: { type: 'Act' } };
    const diagram: Diagram = { ...emptyDiagram('MainTree'), root: 'r', nodes };
    expect(hasRoom(diagram, 'r', vocabulary, 1)).toBe(true);
    expect(hasRoom(diagram, 'r', vocabulary, 2)).toBe(false);
    expect(['AnyNumber', 'Around', 'Act'].map((type) => canMorph(diagram, 'r', spec(type)))).toEqual([
      true,
      false,
      false,
    ]);
    expect(['Own', 'Around', 'Act'].map((type) => canWrapIn(spec(type)))).toEqual([true, true, false]);
  });
});

it('offers the values of a string that has only some', () => {
  const mode = spec('RosSubscribe').ports.find((port) => port.name === 'mode');
  expect(mode?.type).toBe('mode[latest;new;wait]');
  expect(mode?.default).toBe('latest');
});
