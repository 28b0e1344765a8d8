import { encode } from '@msgpack/msgpack';
import { expect, it } from 'vitest';
import { wholeScene } from './sceneParts';

const bytes = new Uint8Array([1, 2]);
const mesh = { positions: bytes, normals: bytes, indices: bytes };
const texture = { jpeg: bytes, tile: [1, 1] };
const shape = (more: object) => ({ shape: 'mesh', size: [1, 1, 1], pose: [], color: [], ...more });

const scene = (meshes: object, textures: object) =>
  encode({
    type: 'scene',
    name: 'w',
    t: 0,
    objects: [{ id: 0, shapes: [shape({ mesh: 'm' }), shape({ shape: 'box', texture: 'x' })] }],
    meshes,
    textures,
    ground_texture: 'x',
  });

it('puts the attached parts into a scene', () => {
  const parts = new Map([
    ['aa', encode(mesh)],
    ['bb', encode(texture)],
  ]);
  const whole = wholeScene(scene({ m: { hash: 'aa' } }, { x: { hash: 'bb' } }), parts);
  expect(whole.meshes).toEqual({ m: mesh });
  expect(whole.textures).toEqual({ x: texture });
  expect(whole.objects[0]!.shapes).toHaveLength(2);
  expect(whole.ground_texture).toBe('x');
});

it('leaves out what is not there', () => {
  const whole = wholeScene(scene({ m: { hash: 'aa' } }, { x: { hash: 'bb' } }), new Map());
  expect(whole.meshes).toEqual({});
  expect(whole.objects[0]!.shapes.map(({ shape: kind, texture: of }) => [kind, of])).toEqual([['box', '']]);
  expect(whole.ground_texture).toBe('');
});

it('reads scenes of version 1, which have their parts within', () => {
  const whole = wholeScene(scene({ m: mesh }, { x: texture }), new Map());
  expect(whole.meshes).toEqual({ m: mesh });
  expect(whole.objects[0]!.shapes).toHaveLength(2);
});

it('takes what is not there from the present world, if it is of the same universe', () => {
  const frame = scene({ m: { hash: 'aa' } }, { x: { hash: 'bb' } });
  const present = { name: 'w', meshes: { m: mesh }, textures: { x: { jpeg: bytes, tile: [1, 1] } } };
  expect(wholeScene(frame, new Map(), present)).toMatchObject({ meshes: { m: mesh }, ground_texture: 'x' });
  expect(wholeScene(frame, new Map(), { ...present, name: 'other' }).meshes).toEqual({});
  const own = { ...mesh, indices: new Uint8Array([9]) };
  expect(wholeScene(frame, new Map([['aa', encode(own)]]), present).meshes).toEqual({ m: own });
});
