import { expect, it } from 'vitest';
import { keyframeStep, tickStep, treeStep, writesStep } from './steps';

it('reads a tree, whose lists may be too short', () => {
  const { nodes } = treeStep(1, {
    generation: 2,
    uid: [1, 2],
    parent: [0, 1],
    type: ['Sequence'],
    path: ['/a', '/a/b'],
  });
  expect(nodes).toHaveLength(2);
  expect(nodes[1]).toMatchObject({ uid: 2, parent: 1, type: '', path: '/a/b', ports: {} });
});

it('reads what the ports were given, as texts', () => {
  const ports_json = ['{"a":"{key}","b":2}', '[1]', 'no JSON'];
  const { nodes } = treeStep(1, { generation: 1, uid: [1, 2, 3], ports_json });
  expect(nodes.map(({ ports }) => ports)).toEqual([{ a: '{key}', b: '2' }, {}, {}]);
});

it('reads statuses, and takes unknown ones as idle', () => {
  const tick = { number: 4, duration_ms: 0.5, changed_uid: [1, 2, 3], changed_status: [1, 3, 9] };
  expect(tickStep(1, tick).changed).toEqual([
    [1, 'RUNNING'],
    [2, 'FAILURE'],
    [3, 'IDLE'],
  ]);
});

it('reads values, and tells previews from objects', () => {
  const { writes } = writesStep(1, {
    scope: ['', ''],
    key: ['a', 'b'],
    type: ['str', 'dict'],
    value_json: ['{"preview":"aaa","bytes":5000,"hash":"0"}', '{"preview":"a","more":1}'],
    removed: [0, 0],
    writer_uid: [3, 0],
  });
  expect(writes[0]).toMatchObject({ value: 'aaa', isPreview: true, writer: 3 });
  expect(writes[1]).toMatchObject({ value: { preview: 'a', more: 1 }, isPreview: false, writer: 0 });
});

it('leaves out what is no entry of a keyframe', () => {
  const json = '[["","a","int",1],["short"],7]';
  expect(keyframeStep(1, { tick: 1, status: [], blackboard_json: json }).entries).toEqual([
    { scope: '', key: 'a', type: 'int', value: 1, isPreview: false },
  ]);
  expect(keyframeStep(1, { tick: 1, status: [], blackboard_json: 'no JSON' }).entries).toEqual([]);
});
