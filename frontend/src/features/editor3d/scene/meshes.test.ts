import * as THREE from 'three';
import { describe, expect, it, vi } from 'vitest';
import { EMPTY_STL, stl } from '../../../../harness/documents';
import { valuesOf } from '../../../../harness/scene';
import { readMesh } from './meshes';

/** Returns a text as the page's buffer type, since the loaders do not accept Node's. */
const bytes = (text: string): ArrayBuffer => Uint8Array.from(text, (letter) => letter.charCodeAt(0)).buffer;
const read = (path: string, text: string) => readMesh(path, bytes(text));

const TRIANGLE = [0, 0, 0, 2, 0, 0, 0, 1, 0];

const OBJ = 'v 0 0 0\nv 2 0 0\nv 0 1 0\nf 1 2 3\n';
const PLY = (last = 2) => `ply
format ascii 1.0
element vertex 3
property float x
property float y
property float z
element face 1
property list uchar int vertex_indices
end_header
0 0 0
2 0 0
0 1 0
3 0 1 ${last}
`;
const DAE = (mesh: string, unit = 0.5) => `<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit meter="${unit}"/><up_axis>Y_UP</up_axis></asset>
<library_geometries>${mesh}</library_geometries>
<library_visual_scenes><visual_scene id="s">${mesh ? '<node id="n"><instance_geometry url="#g"/></node>' : ''}</visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>`;
const GEOMETRY = `<geometry id="g"><mesh><source id="p"><float_array id="pa" count="9">0 0 0 2 0 0 0 1 0</float_array>
<technique_common><accessor source="#pa" count="3" stride="3"><param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles></mesh></geometry>`;

describe('readMesh', () => {
  it.each([
    ['a.stl', stl(2)],
    ['a.STL', stl(2)],
    ['a.obj', OBJ],
    ['a.ply', PLY()],
    ['a.dae', DAE(GEOMETRY, 1)],
  ])('reads %s in its own units and axes, with normals', async (path, text) => {
    const mesh = await read(path, text);
    expect(valuesOf(mesh)).toEqual(TRIANGLE);
    expect(valuesOf(mesh, 'normal')).toEqual([0, 0, 1, 0, 0, 1, 0, 0, 1]);
    expect(mesh.index).toBeNull();
  });

  it('applies the unit of a COLLADA file', async () => {
    const mesh = await read('a.dae', DAE(GEOMETRY, 0.5));
    expect(valuesOf(mesh)).toEqual(TRIANGLE.map((value) => value * 0.5));
  });

  it('asks for no picture of a COLLADA file, and nothing of it stands in the console', async () => {
    const warn = vi.spyOn(console, 'warn');
    const load = vi.spyOn(THREE.TextureLoader.prototype, 'load');
    const look = `<library_images><image id="i"><init_from>../a.png</init_from></image></library_images>
<library_effects><effect id="e"><profile_COMMON><technique sid="t"><phong><diffuse>
<texture texture="i" texcoord="c"><extra/></texture></diffuse></phong></technique></profile_COMMON></effect></library_effects>
<library_materials><material id="m"><instance_effect url="#e"/></material></library_materials>`;
    const bound = `<instance_geometry url="#g"><bind_material><technique_common>
<instance_material symbol="m" target="#m"/></technique_common></bind_material></instance_geometry>`;
    const text = DAE(GEOMETRY.replace('<triangles', '<triangles material="m"'), 1)
      .replace('Y_UP', 'Z_UP')
      .replace('<library_geometries>', `${look}<library_geometries>`)
      .replace('<instance_geometry url="#g"/>', bound);
    expect(valuesOf(await read('a.dae', text))).toEqual(TRIANGLE);
    expect(load).not.toHaveBeenCalled();
    expect(warn).not.toHaveBeenCalled();
  });

  it('joins the objects of a file', async () => {
    const mesh = await read('a.obj', `o one\n${OBJ}o two\nv 0 0 5\nv 1 0 5\nv 0 1 5\nf 4 5 6\n`);
    expect(valuesOf(mesh)).toEqual([...TRIANGLE, 0, 0, 5, 1, 0, 5, 0, 1, 5]);
  });

  it.each([
    ['a.stl', EMPTY_STL, 'it has no triangles'],
    ['a.obj', '# nothing\n', 'it has no triangles'],
    ['a.dae', DAE(''), 'it has no triangles'],
    ['a.ply', PLY(7), 'some of its faces name corners that it does not have'],
    ['a.fbx', '', 'meshes of kind .fbx are not read'],
    ['mesh', '', 'meshes of kind . are not read'],
  ])('reports why %s cannot be used', async (path, text, reason) => {
    await expect(read(path, text)).rejects.toThrow(reason);
  });

  it('reads a binary glTF', async () => {
    const positions = new Float32Array(TRIANGLE);
    const json = JSON.stringify({
      asset: { version: '2.0' },
      scene: 0,
      scenes: [{ nodes: [0] }],
      nodes: [{ mesh: 0, translation: [0, 0, 3] }],
      meshes: [{ primitives: [{ attributes: { POSITION: 0 } }] }],
      accessors: [
        { bufferView: 0, componentType: 5126, count: 3, type: 'VEC3', min: [0, 0, 0], max: [2, 1, 0] },
      ],
      bufferViews: [{ buffer: 0, byteLength: 36 }],
      buffers: [{ byteLength: 36 }],
    });
    const text = new TextEncoder().encode(json.padEnd(Math.ceil(json.length / 4) * 4));
    const file = new DataView(new ArrayBuffer(28 + text.length + 36));
    const words = [0x46546c67, 2, file.byteLength, text.length, 0x4e4f534a];
    words.forEach((word, at) => file.setUint32(at * 4, word, true));
    new Uint8Array(file.buffer).set(text, 20);
    file.setUint32(20 + text.length, 36, true);
    file.setUint32(24 + text.length, 0x004e4942, true);
    new Uint8Array(file.buffer).set(new Uint8Array(positions.buffer), 28 + text.length);
    const mesh = await readMesh('a.glb', file.buffer);
    expect(valuesOf(mesh)).toEqual([0, 0, 3, 2, 0, 3, 0, 1, 3]);
    expect(
      new THREE.Box3().setFromBufferAttribute(mesh.getAttribute('position') as THREE.BufferAttribute).max.z,
    ).toBe(3);
  });
});
