import * as THREE from 'three';
import { describe, expect, it, vi } from 'vitest';
import type { Shape } from '@/generated/messages';
import { GeometryCache } from './geometry';
import { MaterialCache, meshOf, setPose } from './shapes';
import type { Pictures } from './TextureCache';

const SHAPE: Shape = { shape: 'box', size: [1, 1, 1], pose: [1, 2, 3, 0, 0, 1, 0], color: [1, 0.5, 0, 1] };

const pictures = () => {
  const waiting: ((texture: THREE.Texture) => void)[] = [];
  const whenLoaded = vi.fn((_: string, take: (texture: THREE.Texture) => void) => void waiting.push(take));
  return {
    whenLoaded,
    tileOf: vi.fn(() => [0.5, 0.5] as const),
    dispose: vi.fn(),
    waiting,
  } satisfies Pictures & {
    waiting: unknown;
  };
};

describe('setPose', () => {
  it('sets position and rotation, at the origin by default', () => {
    const object = new THREE.Object3D();
    setPose(object.position, object.quaternion, [1, 2, 3, 0, 0, 1, 0]);
    expect([...object.position.toArray(), ...object.quaternion.toArray()]).toEqual([1, 2, 3, 0, 0, 1, 0]);
    setPose(object.position, object.quaternion, []);
    expect([...object.position.toArray(), ...object.quaternion.toArray()]).toEqual([0, 0, 0, 0, 0, 0, 1]);
  });
});

describe('MaterialCache', () => {
  it('makes each colour once, in the colour space of the screen', () => {
    const cache = new MaterialCache(true);
    const material = cache.get([1, 0.5, 0, 1]) as THREE.MeshLambertMaterial;
    expect(material.color.getHexString()).toBe('ff8000');
    expect([material.transparent, material.opacity]).toEqual([false, 1]);
    expect(cache.get([1, 0.5, 0, 1])).toBe(material);
    expect(cache.get([1, 0.5, 0, 0.5])).not.toBe(material);
    expect(cache.get([1, 0.5, 0, 1], 'wood')).not.toBe(material);
    expect((cache.get([]) as THREE.MeshLambertMaterial).color.getHexString()).toBe('b3b3b3');
  });

  it('lets one see through where the colour does', () => {
    const ghost = new MaterialCache(true, null, 0.5);
    expect(ghost.get([1, 1, 1, 1])).toMatchObject({ transparent: true, opacity: 0.5 });
    expect(ghost.get([1, 1, 1, 0.4]).opacity).toBeCloseTo(0.2);
    const material = new MaterialCache(true).get([1, 1, 1, 0.4]);
    expect([material.transparent, material.opacity]).toEqual([true, 0.4]);
  });

  it('is simple with software rendering', () => {
    expect(new MaterialCache(true).get([])).toBeInstanceOf(THREE.MeshLambertMaterial);
    const fine = new MaterialCache(false).get([]) as THREE.MeshStandardMaterial;
    expect(fine).toBeInstanceOf(THREE.MeshStandardMaterial);
    expect([fine.roughness, fine.metalness]).toEqual([0.72, 0.04]);
  });

  it('adds the picture when it has arrived', () => {
    const textures = pictures();
    const material = new MaterialCache(true, textures).get([], 'wood') as THREE.MeshLambertMaterial;
    expect(textures.whenLoaded).toHaveBeenCalledExactlyOnceWith('wood', expect.any(Function));
    expect(material.map).toBeNull();
    const { version } = material;
    const texture = new THREE.Texture();
    textures.waiting[0]!(texture);
    expect(material.map).toBe(texture);
    expect(material.version).toBe(version + 1);
  });

  it('frees what it made', () => {
    const textures = pictures();
    const cache = new MaterialCache(true, textures);
    const freed = vi.fn();
    cache.get([]).addEventListener('dispose', freed);
    cache.dispose();
    expect(freed).toHaveBeenCalledOnce();
    expect(textures.dispose).toHaveBeenCalledOnce();
  });
});

describe('meshOf', () => {
  const geometries = new GeometryCache({});

  it('is at the pose of the shape, and casts a shadow', () => {
    const mesh = meshOf(SHAPE, geometries, new MaterialCache(true));
    expect([...mesh.position.toArray(), ...mesh.quaternion.toArray()]).toEqual(SHAPE.pose);
    expect([mesh.castShadow, mesh.receiveShadow]).toEqual([true, false]);
    expect(mesh.scale.toArray()).toEqual([1, 1, 1]);
  });

  it('of a plane receives shadows only', () => {
    const mesh = meshOf({ ...SHAPE, shape: 'plane', size: [2, 2] }, geometries, new MaterialCache(true));
    expect([mesh.castShadow, mesh.receiveShadow]).toEqual([false, true]);
  });

  it('of a mesh is scaled by its size', () => {
    const scaled = (size: number[]) =>
      meshOf({ ...SHAPE, shape: 'mesh', size }, geometries, new MaterialCache(true)).scale.toArray();
    expect(scaled([2, 3, 4])).toEqual([2, 3, 4]);
    expect(scaled([])).toEqual([1, 1, 1]);
  });

  it('repeats its picture by its size, and requests none without a picture', () => {
    const textures = pictures();
    const materials = new MaterialCache(true, textures);
    expect(meshOf(SHAPE, geometries, materials).geometry).toBe(geometries.get(SHAPE));
    expect(textures.tileOf).not.toHaveBeenCalled();
    const painted = meshOf({ ...SHAPE, texture: 'wood' }, geometries, materials);
    expect(textures.tileOf).toHaveBeenCalledExactlyOnceWith('wood');
    expect(painted.geometry).toBe(geometries.get(SHAPE, [0.5, 0.5]));
  });
});
