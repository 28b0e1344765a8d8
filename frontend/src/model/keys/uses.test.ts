import { describe, expect, it } from 'vitest';
import catalog from '@catalog';
import { emptyDiagram, type DiagramNode } from '../diagram';
import { makeVocabulary, readCatalog } from '../vocabulary';
import { keysOf, usesIn, withKeys } from './uses';

const drive = {
  name: 'Drive',
  kind: 'action',
  open: false,
  ports: [{ name: 'speed', direction: 'input', type: 'double', default: '{cruise}' } as const],
};
const vocabulary = makeVocabulary(readCatalog(catalog), [drive]);

function uses(node: DiagramNode) {
  const diagram = { ...emptyDiagram('Main'), root: 'n', nodes: { n: node } };
  return usesIn(diagram, { diagrams: { Main: diagram }, mainTree: 'Main' }, vocabulary);
}

const renamed = (node: DiagramNode): (string | null)[] =>
  uses(node).map((use) => withKeys(use, (key) => ({ a: 'b', '@a': '@b' })[key] ?? key));

describe('keys', () => {
  it.each([
    [{ type: 'Sleep', ports: { msec: '{a}' } }, ['{b}']],
    [{ type: 'Sleep', ports: { msec: ' {@a} ' } }, [' {@b} ']],
    [{ type: 'Sleep', ports: { msec: 'a' } }, ['a']],
    [{ type: 'Drive', ports: { a: '{=}' } }, ['{b}', '{cruise}']],
    [{ type: 'Script', ports: { code: 'a := 1' } }, ['b := 1']],
    [{ type: 'Script', ports: { code: '{a}' } }, ['{b}']],
    [{ type: 'SetBlackboard', ports: { value: 'a', output_key: 'a' } }, ['a', 'b']],
    [{ type: 'UnsetBlackboard', ports: { key: 'a' } }, ['b']],
    [{ type: 'Sleep', ports: { msec: '1' }, conditions: { _skipIf: 'a % 1', _post: 'a' } }, ['1', null, 'b']],
  ] as [DiagramNode, (string | null)[]][])('of %j are renamed', (node, after) => {
    expect(renamed(node)).toEqual(after);
  });

  it('are those of defaults, too', () => {
    expect(uses({ type: 'Drive' }).flatMap(keysOf)).toEqual(['cruise']);
    expect(uses({ type: 'Drive', ports: { speed: '1' } }).flatMap(keysOf)).toEqual([]);
  });
});
