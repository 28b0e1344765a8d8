import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { emptyDiagram, type Diagram } from '../diagram';
import { edit } from '../edits';
import { canReplace, passagesOf, setText, textAt } from './passages';

const PATH = 'trees/Main.json';
const tree: Diagram = {
  ...emptyDiagram('Main'),
  root: 'r',
  nodes: {
    r: { type: 'Sequence', children: ['a', 's'], comment: 'first speed' },
    a: {
      type: 'Forward',
      name: 'Go',
      ports: { speed: '{speed}' },
      conditions: { _skipIf: 'speed > 1' },
      attributes: { _uid: '7' },
    },
    s: { type: 'SubTree', tree: 'Dock', ports: { goal: '{=}' } },
    d: { type: 'Sleep', ports: { msec: '100' } },
  },
  drafts: ['d'],
};

const passages = passagesOf(PATH, tree);
const found = (part: string) => passages.find(({ place }) => place?.field.part === part)!;

describe('passagesOf', () => {
  it('has all texts of all blocks, in execution order, with the drafts', () => {
    expect(passages.map(({ text }) => text)).toEqual([
      'Sequence',
      'first speed',
      'Go',
      'Forward',
      'speed',
      '{speed}',
      'speed > 1',
      '7',
      'SubTree',
      'Dock',
      'goal',
      '{=}',
      'Sleep',
      'msec',
      '100',
    ]);
  });
});

describe('canReplace', () => {
  it.each(['name', 'comment', 'port', 'condition'])('is true of a %s', (part) => {
    expect(canReplace(found(part))).toBe(true);
  });

  it.each(['type', 'tree', 'portName', 'attribute'])('is false of a %s, which is a reference', (part) => {
    expect(canReplace(found(part))).toBe(false);
    expect(edit(tree, setText(found(part).place!, 'x')).patches).toEqual([]);
  });

  it('is true of files, except for the settings', () => {
    expect(canReplace({ path: 'actions/A.py', place: null, text: '' })).toBe(true);
    expect(canReplace({ path: 'project.json', place: null, text: '' })).toBe(false);
  });
});

describe('setText', () => {
  it('sets exactly the text that textAt reads', () => {
    const words = fc.string({ minLength: 1 }).filter((text) => text.trim() === text);
    fc.assert(
      fc.property(fc.constantFrom(...passages.filter(canReplace)), words, ({ place }, text) => {
        const { diagram } = edit(tree, setText(place!, text));
        const others = (each: Diagram) => passagesOf(PATH, each).map((passage) => passage.text);
        expect(textAt(diagram, place!)).toBe(text);
        expect(
          others(diagram).filter((_, index) => others(tree)[index] !== others(diagram)[index]).length,
        ).toBeLessThanOrEqual(1);
      }),
    );
  });
});

describe('textAt', () => {
  it('is undefined if the block or the field was deleted', () => {
    const { place } = found('condition');
    expect(textAt({ ...tree, nodes: {} }, place!)).toBeUndefined();
    expect(textAt({ ...tree, nodes: { a: { type: 'Forward' } } }, place!)).toBeUndefined();
  });
});
