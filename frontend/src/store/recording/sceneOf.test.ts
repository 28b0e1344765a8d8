import { encode } from '@msgpack/msgpack';
import { expect, it } from 'vitest';
import { sceneOf } from './sceneOf';

const shape = { shape: 'box', size: [1, 1, 1], pose: [0, 0, 0, 0, 0, 0, 1], color: [1, 1, 1, 1] };
const scene = {
  ...{ type: 'scene', name: 'w', t: 0, ground_color: [1, 1, 1] },
  objects: [{ id: 1, body: 'b', link: '', kind: 'static', shapes: [shape], pose: [0, 0, 0, 0, 0, 0, 1] }],
  meshes: { m: { positions: new Uint8Array(12), normals: new Uint8Array(12), indices: new Uint8Array(12) } },
  lights: [{ direction: [0, 0, -1], intensity: 1 }],
  sensors: [{ name: 'lidar', kind: 'lidar', object_id: 1, pose: [0, 0, 0, 0, 0, 0, 1], fov: 1, range: 1 }],
};

it('reads a scene', () => {
  expect(sceneOf(encode(scene))).toMatchObject(scene);
});

it.each([
  { type: 'poses' },
  { objects: [{ ...scene.objects[0], pose: [0, 0] }] },
  { objects: [{ ...scene.objects[0], shapes: [{ ...shape, size: ['x'] }] }] },
  { meshes: { m: { ...scene.meshes.m, positions: new Uint8Array(5) } } },
  { lights: 3 },
  { sensors: [{ name: 'x' }] },
  { textures: { t: {} } },
])('does not draw what is no scene: %o', (wrong) => {
  expect(sceneOf(encode({ ...scene, ...wrong }))).toBeNull();
  expect(sceneOf(new Uint8Array([0xc1]))).toBeNull();
});

it('puts the parts in which the recording holds once, and checks them', () => {
  const mesh = scene.meshes.m;
  const shapes = [{ ...shape, shape: 'mesh', mesh: 'm' }];
  const slim = { ...scene, objects: [{ ...scene.objects[0], shapes }], meshes: { m: { hash: 'aa' } } };
  expect(sceneOf(encode(slim), new Map([['aa', encode(mesh)]]))?.meshes).toEqual({ m: mesh });
  expect(sceneOf(encode(slim), new Map([['aa', encode({ positions: 3 })]]))).toBeNull();
  expect(sceneOf(encode(slim), new Map([['aa', new Uint8Array([0xc1])]]))).toBeNull();
  expect(sceneOf(encode(slim))?.objects[0]?.shapes).toEqual([]);
  expect(sceneOf(encode({ ...slim, objects: 3 }))).toBeNull();
});
