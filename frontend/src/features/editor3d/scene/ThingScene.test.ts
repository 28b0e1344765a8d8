import * as THREE from 'three';
import { describe, expect, it, vi } from 'vitest';
import type { Shape } from '@/generated/messages';
import type { Pictures } from '@/features/viewer/scene/TextureCache';
import { stl } from '../../../../harness/documents';
import { objectsOf, valuesOf } from '../../../../harness/scene';
import { fakeServer, openProject } from '../../../../harness/testing';
import type { Fetched } from './assets';
import { frameOf } from './marks';
import { arrival, rgba, ThingScene } from './ThingScene';

interface Plain {
  readonly key: string;
  readonly x: number;
  readonly look: string;
  readonly shapes: Fetched<Shape[]>;
}

const BOX: Shape = { shape: 'box', size: [1, 1, 1], pose: [0, 0, 0, 0, 0, 0, 1], color: [1, 0, 0, 1] };
const here = (...shapes: Shape[]): Fetched<Shape[]> => ({ value: shapes, failed: false });

/** A scene of things that are placed along x and drawn by their shapes. */
class PlainScene extends ThingScene<Plain> {
  protected stateOf({ shapes }: Plain): unknown {
    return this.arrivals(shapes);
  }
  protected fill(node: THREE.Group, { shapes }: Plain): void {
    this.addShapes(node, shapes, 0.5);
    node.add(frameOf(node));
    const line = new THREE.Line(new THREE.BufferGeometry(), new THREE.LineBasicMaterial());
    line.userData['isFaint'] = true;
    node.add(line);
  }
  protected put(node: THREE.Group, { x }: Plain): void {
    node.position.x = x;
  }
  protected override lookOf({ look }: Plain): unknown {
    return look;
  }
}

const thing = (key: string, more: Partial<Plain> = {}): Plain => ({
  key,
  x: 0,
  look: '',
  shapes: here(BOX),
  ...more,
});

function begin(textures: Pictures | null = null) {
  const onArrival = vi.fn();
  return { scene: new PlainScene(true, onArrival, textures), onArrival };
}

const size = (scene: PlainScene, key: string) =>
  scene
    .boundsOf([key])
    .getSize(new THREE.Vector3())
    .toArray()
    .map((part) => Math.round(part * 1e4) / 1e4);
const mark = (scene: PlainScene, key: string) =>
  scene.nodeOf(key)!.children.find(({ userData }) => userData['isMark'])!;
const faint = (scene: PlainScene, key: string) =>
  (
    scene.nodeOf(key)!.children.find(({ userData }) => userData['isFaint']) as THREE.Line<
      THREE.BufferGeometry,
      THREE.LineBasicMaterial
    >
  ).material.opacity;

describe('rgba', () => {
  it.each([
    ['#ff8000', [1, 128 / 255, 0, 1]],
    ['#ff800080', [1, 128 / 255, 0, 128 / 255]],
    ['red', [expect.any(Number), 0.6, 0.6, 1]],
    ['', [0.6, 0.6, 0.6, 1]],
  ])('reads %s', (color, parts) => {
    expect(rgba(color)).toEqual(parts);
  });
});

describe('an arrival', () => {
  it('reports whether an object has arrived', () => {
    expect(arrival({ value: [], failed: false })).toBe('here');
    expect(arrival({ value: null, failed: false })).toBe('coming');
    expect(arrival({ value: null, failed: true })).toBe('failed');
  });
});

describe('a scene of things', () => {
  it('draws things at their places, and returns their bounds', () => {
    const { scene } = begin();
    scene.show([thing('a', { x: -2 }), thing('b', { x: 3 })]);
    expect(scene.group.children).toHaveLength(2);
    expect([scene.bounds.min.x, scene.bounds.max.x]).toEqual([-2.5, 3.5]);
    expect(size(scene, 'a')).toEqual([1, 1, 1]);
    expect(scene.boundsOf(['gone']).isEmpty()).toBe(true);
  });

  it('only moves things that look the same, and draws the others again', () => {
    const { scene } = begin();
    scene.show([thing('a'), thing('b'), thing('c')]);
    const [a, b] = ['a', 'b'].map((key) => scene.nodeOf(key));
    scene.show([thing('a', { x: 4 }), thing('b', { look: 'other' })]);
    expect(scene.nodeOf('a')).toBe(a);
    expect(a?.position.x).toBe(4);
    expect(scene.nodeOf('b')).not.toBe(b);
    expect(scene.nodeOf('c')).toBeUndefined();
    expect(scene.group.children).toEqual([a, scene.nodeOf('b')]);
  });

  it('returns the thing of each of its parts', () => {
    const { scene } = begin();
    scene.show([thing('a')]);
    expect(scene.keyOf(mark(scene, 'a'))).toBe('a');
    expect(scene.keyOf(scene.group)).toBeNull();
  });

  it('frames the selection, also after it was drawn again', () => {
    const { scene } = begin();
    scene.show([thing('a'), thing('b')]);
    scene.mark(['a']);
    expect([mark(scene, 'a').visible, mark(scene, 'b').visible]).toEqual([true, false]);
    expect([faint(scene, 'a'), faint(scene, 'b')]).toEqual([1, 0.35]);
    scene.show([thing('a', { look: 'other' }), thing('b')]);
    expect(mark(scene, 'a').visible).toBe(true);
    scene.mark([]);
    expect(mark(scene, 'a').visible).toBe(false);
  });

  it('shows a box for shapes that are loading, and another colour if they failed', () => {
    const { scene } = begin();
    scene.show([
      thing('a', { shapes: { value: null, failed: false } }),
      thing('b', { shapes: { value: null, failed: true } }),
    ]);
    expect(size(scene, 'a')).toEqual([0.5, 0.5, 0.5]);
    const colors = ['a', 'b'].map((key) => {
      const [mesh] = objectsOf(scene.nodeOf(key)!, THREE.Mesh);
      return (mesh!.material as THREE.MeshBasicMaterial).color.getHexString();
    });
    expect(colors).toEqual(['999ea8', 'd94038']);
    scene.show([thing('a')]);
    expect(size(scene, 'a')).toEqual([1, 1, 1]);
  });

  it('receives shadows, except on its marks', () => {
    const { scene } = begin();
    scene.show([thing('a')]);
    const [mesh] = objectsOf(scene.nodeOf('a')!, THREE.Mesh);
    expect(mesh!.receiveShadow).toBe(true);
  });

  it('frees the objects that only it uses', () => {
    const { scene } = begin();
    scene.show([thing('a')]);
    const freed = vi.fn();
    (mark(scene, 'a') as THREE.LineSegments).geometry.addEventListener('dispose', freed);
    const [mesh] = objectsOf(scene.nodeOf('a')!, THREE.Mesh);
    const shared = vi.fn();
    mesh!.geometry.addEventListener('dispose', shared);
    scene.show([]);
    expect(freed).toHaveBeenCalledOnce();
    expect(shared).not.toHaveBeenCalled();
    scene.dispose();
    expect(shared).toHaveBeenCalledOnce();
  });
});

describe('meshes of things', () => {
  const CHAIR: Shape = { ...BOX, shape: 'mesh', mesh: 'assets/a.stl', size: [2, 3, 1] };
  const serve = () => {
    fakeServer({ 'GET /projects/p1/files/assets/a.stl': new Response(stl(1)) });
    openProject({ texts: { 'assets/a.stl': '' } });
  };

  it('replace a box as soon as they arrive, with the size of the shape', async () => {
    serve();
    const { scene, onArrival } = begin();
    scene.show([thing('a', { shapes: here(CHAIR) })]);
    expect(size(scene, 'a')).toEqual([0.4, 0.4, 0.4]);
    await vi.waitFor(() => expect(onArrival).toHaveBeenCalledOnce());
    expect(size(scene, 'a')).toEqual([2, 3, 0]);
  });

  it('get texture coordinates by size if they have a picture', async () => {
    serve();
    const textures: Pictures = {
      whenLoaded: () => undefined,
      tileOf: () => [2, 1],
      dispose: () => undefined,
    };
    const { scene, onArrival } = begin(textures);
    scene.show([thing('a', { shapes: here({ ...CHAIR, texture: 'wood' }) })]);
    await vi.waitFor(() => expect(onArrival).toHaveBeenCalledOnce());
    const [mesh] = objectsOf(scene.nodeOf('a')!, THREE.Mesh);
    expect(valuesOf(mesh!.geometry, 'uv')).toEqual([0, 0, 1, 0, 0, 3]);
    expect(valuesOf(mesh!.geometry)).toEqual([0, 0, 0, 1, 0, 0, 0, 1, 0]);
  });
});
