import { beforeEach, describe, expect, it, vi } from 'vitest';
import { valuesOf } from '../../../../harness/scene';
import { selfContained } from './gltf';
import { readMesh } from './meshes';

const TRIANGLE = [0, 0, 0, 2, 0, 0, 0, 1, 0];
const document = (uri: string) =>
  JSON.stringify({
    asset: { version: '2.0' },
    scene: 0,
    scenes: [{ nodes: [0] }],
    nodes: [{ mesh: 0 }],
    meshes: [{ primitives: [{ attributes: { POSITION: 0 }, material: 0 }] }],
    accessors: [
      { bufferView: 0, componentType: 5126, count: 3, type: 'VEC3', min: [0, 0, 0], max: [2, 1, 0] },
    ],
    bufferViews: [{ buffer: 0, byteLength: 36 }],
    buffers: [{ byteLength: 36, uri }],
    materials: [{ pbrMetallicRoughness: { baseColorTexture: { index: 0 } } }],
    textures: [{ source: 0 }],
    images: [{ uri: 'look.png' }],
  });
const bytes = (text: string): ArrayBuffer => Uint8Array.from(text, (letter) => letter.charCodeAt(0)).buffer;
const beside = () => Promise.resolve(new Float32Array(TRIANGLE).buffer);

/** A buffer as its document may hold it, in letters of base64 and otherwise. */
const text = String.fromCharCode(...new Uint8Array(new Float32Array(TRIANGLE).buffer));
const HELD = [
  `data:application/octet-stream;base64,${btoa(text)}`,
  `data:;base64,${encodeURIComponent(btoa(text))}`,
  `data:application/octet-stream,${[...text].map((letter) => `%${letter.charCodeAt(0).toString(16).padStart(2, '0')}`).join('')}`,
];

beforeEach(() => {
  // The page's policy lets no `data:` be fetched, and nothing else is to be.
  vi.stubGlobal('fetch', () => Promise.reject(new TypeError('refused by the policy')));
  return () => vi.unstubAllGlobals();
});

describe('a glTF', () => {
  it('is read with the buffers that lie beside it, and without its pictures', async () => {
    const asked = vi.fn(beside);
    const mesh = await readMesh('a.gltf', bytes(document('bin/a%20b.bin')), asked);
    expect(valuesOf(mesh)).toEqual(TRIANGLE);
    expect(asked.mock.calls).toEqual([['bin/a b.bin']]);
  });

  it.each(HELD)('is read with a buffer that it holds itself: %s', async (uri) => {
    const asked = vi.fn(beside);
    expect(valuesOf(await readMesh('a.gltf', bytes(document(uri)), asked))).toEqual(TRIANGLE);
    expect(asked).not.toHaveBeenCalled();
  });

  it('names no picture', async () => {
    expect((await selfContained(document(HELD[0]!), beside)).document).not.toContain('look.png');
  });

  it('of which a buffer names nothing cannot be used', async () => {
    const none = JSON.stringify({ asset: { version: '2.0' }, buffers: [{ byteLength: 4 }] });
    await expect(readMesh('a.gltf', bytes(none))).rejects.toThrow('buffer 0');
  });

  it('of which a buffer is missing cannot be used', async () => {
    await expect(readMesh('a.gltf', bytes(document('gone.bin')))).rejects.toThrow('gone.bin');
  });
});
