import { notifications } from '@mantine/notifications';
import { beforeEach, describe, expect, it, vi } from 'vitest';
import { useProjectStore } from '@/store/project';
import { EMPTY_STL, stl, takesFile } from '../../../harness/documents';
import { fakeServer, openProject } from '../../../harness/testing';
import { bringMesh, MESH_KINDS } from './upload';

beforeEach(() => {
  openProject({ texts: { 'assets/chair.stl': '', 'assets/chair_2.stl': '' } });
});

const shown = () => vi.spyOn(notifications, 'show');

describe('bringMesh', () => {
  it('stores a mesh under a free name, and returns its length', async () => {
    const { requests } = fakeServer(takesFile('assets/chair_3.stl'));
    expect(await bringMesh(new File([stl(30)], 'chair.STL'), 'assets')).toEqual({
      path: 'assets/chair_3.stl',
      extent: 30,
    });
    expect(requests.map(({ method, path }) => `${method} ${path}`)).toEqual([
      'POST /projects/p1/changes',
      'GET /projects/p1',
    ]);
    expect(requests[0]?.body).toMatchObject({ files: [{ path: 'assets/chair_3.stl', base_revision: 0 }] });
    expect('assets/chair_3.stl' in useProjectStore.getState().files).toBe(true);
  });

  it('keeps only characters that a path may have', async () => {
    fakeServer(takesFile('meshes/my_ch_ir.v1.stl'));
    const mesh = await bringMesh(new File([stl(0.5)], 'my chäir.v1.stl'), 'meshes');
    expect(mesh).toEqual({ path: 'meshes/my_ch_ir.v1.stl', extent: 1 });
  });

  it.each([
    ['cube.stl', EMPTY_STL, 'it has no triangles'],
    ['cube.fbx', 'x', 'meshes of kind .fbx are not read'],
  ])('refuses %s, with the reason', async (name, content, reason) => {
    const message = shown();
    const { requests } = fakeServer({});
    expect(await bringMesh(new File([content], name), 'assets')).toBeNull();
    expect(message).toHaveBeenCalledWith({ color: 'red', message: `${name} cannot be used: ${reason}` });
    expect(requests).toEqual([]);
  });

  it('refuses a mesh that is larger than the simulator reads', async () => {
    const message = shown();
    const file = new File([stl(1)], 'big.stl');
    Object.defineProperty(file, 'size', { value: 50_000_001 });
    expect(await bringMesh(file, 'assets')).toBeNull();
    expect(message).toHaveBeenCalledWith({
      color: 'red',
      message: 'big.stl cannot be used: it is larger than 50 MB',
    });
  });

  it('accepts a mesh of just that size', async () => {
    fakeServer(takesFile('assets/big.stl'));
    const file = new File([stl(1)], 'big.stl');
    Object.defineProperty(file, 'size', { value: 50_000_000 });
    expect(await bringMesh(file, 'assets')).toMatchObject({ path: 'assets/big.stl' });
  });

  it('reports a refusal of the server', async () => {
    const message = shown();
    fakeServer({});
    expect(await bringMesh(new File([stl(1)], 'a.stl'), 'assets')).toBeNull();
    expect(message).toHaveBeenCalledWith({ color: 'red', message: 'a.stl cannot be used: Not found' });
  });

  it('does nothing without a project', async () => {
    useProjectStore.getState().close();
    expect(await bringMesh(new File([stl(1)], 'a.stl'), 'assets')).toBeNull();
  });

  it('names the kinds of files', () => {
    expect(MESH_KINDS).toBe('.stl,.obj,.dae,.ply,.glb');
  });
});
