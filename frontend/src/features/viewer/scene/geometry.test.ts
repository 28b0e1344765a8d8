import * as THREE from 'three';
import { describe, expect, it, vi } from 'vitest';
import type { Mesh, Shape } from '@/generated/messages';
import { valuesOf } from '../../../../harness/scene';
import { GeometryCache } from './geometry';

const shape = (kind: Shape['shape'], size: number[], mesh = ''): Shape => ({
  shape: kind,
  size,
  pose: [0, 0, 0, 0, 0, 0, 1],
  color: [1, 1, 1, 1],
  mesh,
});

const floats = (...values: number[]) => new Uint8Array(new Float32Array(values).buffer);
const TRIANGLE: Mesh = {
  positions: floats(0, 0, 0, 1, 0, 0, 0, 1, 0),
  normals: new Uint8Array(0),
  indices: new Uint8Array(new Uint32Array([0, 1, 2]).buffer),
};

const sizeOf = (geometry: THREE.BufferGeometry) => {
  geometry.computeBoundingBox();
  return geometry
    .boundingBox!.getSize(new THREE.Vector3())
    .toArray()
    .map((part) => Math.round(part * 1e3) / 1e3);
};

describe('GeometryCache', () => {
  it.each([
    ['box', [1, 2, 3], [1, 2, 3]],
    ['cylinder', [0.5, 3], [1, 1, 3]],
    ['capsule', [0.5, 2], [1, 1, 3]],
    ['sphere', [2], [4, 4, 4]],
    ['plane', [2, 3], [2, 3, 0]],
  ] as const)('makes a %s along z, of the size %o', (kind, size, extent) => {
    expect(sizeOf(new GeometryCache({}).get(shape(kind, [...size])))).toEqual(extent);
  });

  it('makes shapes of a metre if no size is given', () => {
    expect(sizeOf(new GeometryCache({}).get(shape('box', [])))).toEqual([1, 1, 1]);
  });

  it('reads a mesh, and adds the normals that it lacks', () => {
    const cache = new GeometryCache({
      a: TRIANGLE,
      b: { ...TRIANGLE, normals: floats(0, 1, 0, 0, 1, 0, 0, 1, 0) },
    });
    const plain = cache.get(shape('mesh', [2, 2, 2], 'a'));
    expect(valuesOf(plain)).toEqual([0, 0, 0, 1, 0, 0, 0, 1, 0]);
    expect([...plain.index!.array]).toEqual([0, 1, 2]);
    expect(valuesOf(plain, 'normal')).toEqual([0, 0, 1, 0, 0, 1, 0, 0, 1]);
    expect(valuesOf(cache.get(shape('mesh', [1, 1, 1], 'b')), 'normal')).toEqual([0, 1, 0, 0, 1, 0, 0, 1, 0]);
  });

  it('makes each shape once, whatever the scale of a mesh', () => {
    const cache = new GeometryCache({ a: TRIANGLE, b: TRIANGLE });
    expect(cache.get(shape('box', [1, 2, 3]))).toBe(cache.get(shape('box', [1, 2, 3])));
    expect(cache.get(shape('box', [1, 2, 3]))).not.toBe(cache.get(shape('box', [1, 2, 4])));
    expect(cache.get(shape('mesh', [1, 1, 1], 'a'))).toBe(cache.get(shape('mesh', [2, 2, 2], 'a')));
    expect(cache.get(shape('mesh', [1, 1, 1], 'a'))).not.toBe(cache.get(shape('mesh', [1, 1, 1], 'b')));
    const tiled = cache.get(shape('mesh', [1, 1, 1], 'a'), [1, 1]);
    expect(tiled).not.toBe(cache.get(shape('mesh', [2, 2, 2], 'a'), [1, 1]));
    expect(tiled).not.toBe(cache.get(shape('mesh', [1, 1, 1], 'a'), [1, 2]));
    expect(tiled).toBe(cache.get(shape('mesh', [1, 1, 1], 'a'), [1, 1]));
  });

  it('has nothing for a missing mesh, with a picture or without', () => {
    const cache = new GeometryCache({});
    expect(cache.get(shape('mesh', [1, 1, 1], 'gone')).hasAttribute('position')).toBe(false);
    expect(cache.get(shape('mesh', [1, 1, 1], 'gone'), [1, 1]).hasAttribute('position')).toBe(false);
  });

  it('frees its geometries, and makes them again', () => {
    const cache = new GeometryCache({});
    const box = cache.get(shape('box', [1, 1, 1]));
    const freed = vi.fn();
    box.addEventListener('dispose', freed);
    cache.dispose();
    expect(freed).toHaveBeenCalledOnce();
    expect(cache.get(shape('box', [1, 1, 1]))).not.toBe(box);
  });
});
