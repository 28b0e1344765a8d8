import { expect, it } from 'vitest';
import { fieldsOf, isSame, placesOf, valueOf, withValue } from './operation';

const node = { type: 'Sleep', ports: { msec: '1' }, children: ['a'], position: [1, 2] as const };

it('has a field for each key of a record, and none for children', () => {
  expect([...fieldsOf(node).keys()]).toEqual(['type', 'ports/msec', 'position']);
  expect(valueOf(node, ['ports', 'msec'])).toBe('1');
  expect([valueOf(node, ['name']), valueOf(node, ['ports', 'toString'])]).toEqual([null, null]);
});

it('sets and removes fields, and removes a record with its last key', () => {
  expect(withValue(node, ['ports', 'msec'], null)).toEqual({ ...node, ports: undefined });
  expect(withValue(node, ['ports', 'x'], '2').ports).toEqual({ msec: '1', x: '2' });
  expect(withValue({ type: 'A' }, ['conditions', '_while'], 'x')).toEqual({
    type: 'A',
    conditions: { _while: 'x' },
  });
  expect(withValue({ type: 'A', name: 'n' }, ['name'], null)).toEqual({ type: 'A' });
});

it('compares values whatever the order of their keys', () => {
  expect(isSame({ a: 1, b: [1, 2] }, { b: [1, 2], a: 1 })).toBe(true);
  expect(isSame({ a: 1 }, { a: 1, b: undefined })).toBe(true);
  expect([isSame([1], { 0: 1 }), isSame(null, {}), isSame({ a: 1 }, { a: 2 })]).toEqual([
    false,
    false,
    false,
  ]);
});

it('knows the place of each node', () => {
  const places = placesOf({
    format: 'bt-studio/diagram',
    version: 1,
    id: 'Main',
    root: 'r',
    nodes: { r: { type: 'Sequence', children: ['a'] }, a: { type: 'A' }, d: { type: 'D' } },
    drafts: ['d'],
    layout: 'vertical',
  });
  expect(Object.fromEntries(places)).toEqual({ r: 'root', a: { parent: 'r' }, d: 'draft' });
});
