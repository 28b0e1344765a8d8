import { describe, expect, it, vi } from 'vitest';
import { stl } from '../../../../harness/documents';
import { valuesOf } from '../../../../harness/scene';
import { fakeServer, openProject } from '../../../../harness/testing';
import { Assets } from './assets';

const urdf = (mesh: string) =>
  `<robot name="r"><link name="base"><visual><geometry><mesh filename="${mesh}"/></geometry></visual></link></robot>`;

function begin(
  texts: Readonly<Record<string, string>> = {},
  answers: Readonly<Record<string, unknown>> = {},
) {
  const server = fakeServer(answers);
  openProject({ texts });
  const onArrival = vi.fn();
  const assets = new Assets(onArrival);
  const arrived = (count = 1) => vi.waitFor(() => expect(onArrival).toHaveBeenCalledTimes(count));
  return { assets, onArrival, arrived, ...server };
}

const FILES = { 'assets/a.stl': '', 'assets/lost.stl': '', 'a.obj': '' };
const MESH = { 'GET /projects/p1/files/assets/a.stl': new Response(stl(2)) };

describe('meshes', () => {
  it('are fetched once, and then available', async () => {
    const { assets, arrived, requests } = begin(FILES, MESH);
    const entry = assets.mesh('assets/a.stl');
    expect(entry).toEqual({ value: null, failed: false });
    await arrived();
    expect(assets.mesh('assets/a.stl')).toBe(entry);
    expect(valuesOf(entry.value!)).toEqual([0, 0, 0, 2, 0, 0, 0, 1, 0]);
    expect(requests).toHaveLength(1);
  });

  it('fail if the file is missing or unreadable', async () => {
    const answers = { 'GET /projects/p1/files/a.obj': new Response('nothing') };
    const { assets, arrived, requests } = begin(FILES, answers);
    const gone = assets.mesh('assets/gone.stl');
    const lost = assets.mesh('assets/lost.stl');
    const empty = assets.mesh('a.obj');
    await arrived(3);
    // What the project does not have is not asked for.
    expect(requests).toHaveLength(2);
    expect([gone, lost, empty]).toEqual([
      { value: null, failed: true },
      { value: null, failed: true },
      { value: null, failed: true },
    ]);
  });

  it('of glTF have the buffers that lie beside them, in the folder that they say or not', async () => {
    const buffers = [{ byteLength: 36, uri: 'bin/a.bin' }];
    const text = JSON.stringify({ asset: { version: '2.0' }, buffers });
    const answers = {
      'GET /projects/p1/files/assets/a.gltf': new Response(text),
      'GET /projects/p1/files/assets/a.bin': new Response(new Uint8Array(36)),
    };
    const { assets, arrived, requests } = begin({ 'assets/a.gltf': '', 'assets/a.bin': '' }, answers);
    assets.mesh('assets/a.gltf');
    await arrived();
    expect(requests).toHaveLength(2);
  });

  it.each(['./assets/a.stl', 'robots/mine/../../assets/a.stl', 'assets//./b/../a.stl'])(
    'are found by a name with dots: %s',
    async (path) => {
      const { assets, arrived } = begin(FILES, MESH);
      const entry = assets.mesh(path);
      await arrived();
      expect(entry.failed).toBe(false);
      expect(valuesOf(entry.value!)).toEqual([0, 0, 0, 2, 0, 0, 0, 1, 0]);
    },
  );

  it('of a URDF may lie above it', async () => {
    const model = { 'robots/mine/mine.urdf': urdf('../../assets/a.stl') };
    const { assets, arrived } = begin({ ...FILES, ...model }, MESH);
    const entry = assets.robot('mine');
    await arrived();
    const mesh = assets.mesh(entry.value?.[0]?.mesh ?? '');
    await arrived(2);
    expect(mesh.failed).toBe(false);
  });

  it('of glTF may have buffers above it, and one of that name beside it is another one', async () => {
    const document = { asset: { version: '2.0' }, buffers: [{ byteLength: 36, uri: '../x.bin' }] };
    const answers = { 'GET /projects/p1/files/assets/a.gltf': new Response(JSON.stringify(document)) };
    const files = { 'assets/a.gltf': '', 'assets/x.bin': '', 'x.bin': '' };
    const { assets, arrived, requests } = begin(files, answers);
    assets.mesh('assets/a.gltf');
    await arrived();
    expect(requests.at(-1)?.path).toBe('/projects/p1/files/x.bin');
  });

  it('are freed at the end, and later ones are not announced', async () => {
    const { assets, arrived, onArrival } = begin(FILES, MESH);
    const entry = assets.mesh('assets/a.stl');
    await arrived();
    const freed = vi.fn();
    entry.value!.addEventListener('dispose', freed);
    const late = assets.mesh('assets/gone.stl');
    assets.dispose();
    expect(freed).toHaveBeenCalledOnce();
    await vi.waitFor(() => expect(late.failed).toBe(true));
    await Promise.resolve();
    expect(onArrival).toHaveBeenCalledOnce();
  });
});

describe('robots', () => {
  it('of the project are read from the project, with their meshes', async () => {
    const { assets, arrived, requests } = begin({ 'robots/mine/urdf/mine.urdf': urdf('./meshes/a.stl') });
    const entry = assets.robot('mine');
    await arrived();
    expect(entry.value).toMatchObject([{ shape: 'mesh', mesh: 'robots/mine/urdf/meshes/a.stl' }]);
    expect(requests).toEqual([]);
  });

  it('may refer to meshes of their package from its top', async () => {
    const { assets, arrived } = begin({ 'robots/mine/urdf/mine.urdf': urdf('package://mine/meshes/a.stl') });
    const entry = assets.robot('mine');
    await arrived();
    expect(entry.value).toMatchObject([{ mesh: 'robots/mine/meshes/a.stl' }]);
  });

  it('that are built in are requested from the server', async () => {
    const { assets, arrived, requests } = begin(
      { 'robots/other/a.urdf': '' },
      {
        'GET /catalog/robots/rover/urdf': new Response(
          urdf('a.stl').replace(/<mesh[^>]*>/, '<box size="1 1 1"/>'),
        ),
      },
    );
    const entry = assets.robot('rover');
    await arrived();
    expect(entry.value).toMatchObject([{ shape: 'box', size: [1, 1, 1] }]);
    expect(entry.value?.[0]).not.toHaveProperty('mesh');
    expect(requests).toHaveLength(1);
  });

  it('fail if the robot is missing, or has no URDF', async () => {
    const { assets, arrived } = begin({ 'robots/mine/a.urdf': 'no xml' });
    const entries = [assets.robot('mine'), assets.robot('gone')];
    await arrived(2);
    expect(entries.map(({ failed }) => failed)).toEqual([true, true]);
  });
});

describe('models', () => {
  it('are read from the project; other formats cannot be shown', async () => {
    const { assets, arrived } = begin({ 'models/a.urdf': urdf('a.stl'), 'models/b.xacro': urdf('a.stl') });
    const [known, other] = [assets.model('models/a.urdf'), assets.model('models/b.xacro')];
    await arrived(2);
    expect(known.value).toMatchObject([{ mesh: 'models/a.stl' }]);
    expect(other).toEqual({ value: null, failed: true });
    expect(assets.model('models/a.urdf')).toBe(known);
  });
});
