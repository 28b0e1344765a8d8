import { readFileSync } from 'node:fs';
import { expect, it } from 'vitest';
import { isOtherVariant, VARIANTS, variantOf } from './variants';

it('a type is known as a variant, and the first one stands for all', () => {
  expect([variantOf('Switch4'), variantOf('LoopInt'), variantOf('Sequence')]).toEqual([
    'Switch',
    'Loop',
    null,
  ]);
  expect(['Switch2', 'Switch3', 'LoopInt', 'LoopBool', 'Sequence'].map(isOtherVariant)).toEqual([
    ...[false, true, false, true, false],
  ]);
});

it('all variants of the catalogue are listed', () => {
  const text = readFileSync('../tree_gardener/catalog.json', 'utf-8');
  const types = new Set(text.match(/"(?:Switch\d|Loop[A-Z]\w*)"/g)?.map((each) => each.slice(1, -1)));
  expect(types).toEqual(new Set(Object.values(VARIANTS).flat()));
});
