import * as THREE from 'three';
import { describe, expect, it } from 'vitest';
import { GeometryCache } from './geometry';
import { mapPicture } from './mapping';

const HERE = [0, 0, 0, 0, 0, 0, 1];

function uvsOf(shape: 'box' | 'cylinder' | 'sphere' | 'plane', size: number[], tile: [number, number]) {
  const geometry = new GeometryCache({}).get({ shape, size, pose: HERE, color: [1, 1, 1, 1] }, tile);
  const points = geometry.getAttribute('position');
  const uvs = geometry.getAttribute('uv');
  return Array.from({ length: points.count }, (_, i) => ({
    at: new THREE.Vector3().fromBufferAttribute(points, i),
    u: uvs.getX(i),
    v: uvs.getY(i),
  }));
}

describe('pictures on shapes', () => {
  it('are on a box by size, from its lowest corner, never mirrored', () => {
    const found = uvsOf('box', [4, 0.2, 2], [0.5, 1]);
    let seen = 0;
    for (let i = 0; i < found.length; i += 3) {
      const triangle = found.slice(i, i + 3);
      if (triangle.some(({ at }) => at.y > -0.09)) continue;
      // Seen from -y, x grows to the right and z upwards, like u and v.
      for (const { at, u, v } of triangle) {
        expect([u, v]).toEqual([expect.closeTo((at.x + 2) / 0.5, 4), expect.closeTo(at.z + 1, 4)]);
        seen += 1;
      }
    }
    expect(seen).toBe(6);
    expect(Math.max(...found.map(({ u }) => u))).toBeCloseTo(8);
    expect(Math.max(...found.map(({ v }) => v))).toBeCloseTo(2);
  });

  it('are on a plane from its corner', () => {
    for (const { at, u, v } of uvsOf('plane', [2, 1.2], [0.8, 0.8])) {
      expect(u).toBeCloseTo((at.x + 1) / 0.8);
      expect(v).toBeCloseTo((at.y + 0.6) / 0.8);
    }
  });

  it.each(['cylinder', 'sphere'] as const)('go round a %s without a jump', (shape) => {
    const found = uvsOf(shape, shape === 'cylinder' ? [0.3, 1] : [0.3], [0.4, 0.4]);
    let widest = 0;
    for (let i = 0; i < found.length; i += 3) {
      const triangle = found.slice(i, i + 3);
      if (triangle.some(({ at }) => Math.hypot(at.x, at.y) < 0.1)) continue;
      const us = triangle.map(({ u }) => u);
      widest = Math.max(widest, Math.max(...us) - Math.min(...us));
    }
    expect(widest).toBeLessThan(1.2);
  });

  it('have the same size on a mesh whatever its scale, and use its own coordinates if it has any', () => {
    const floats = (...values: number[]) => new Uint8Array(new Float32Array(values).buffer);
    const mesh = {
      positions: floats(0, 0, 0, 1, 0, 0, 0, 0, 1),
      normals: floats(0, -1, 0, 0, -1, 0, 0, -1, 0),
      indices: new Uint8Array(new Uint32Array([0, 1, 2]).buffer),
    };
    const uvs = floats(0, 0, 0.25, 0, 0, 0.5);
    const shape = { shape: 'mesh' as const, size: [2, 1, 3], pose: HERE, color: [1, 1, 1, 1] };
    const cache = new GeometryCache({ plain: mesh, own: { ...mesh, uvs } });
    const most = (name: string) => [...cache.get({ ...shape, mesh: name }, [1, 1]).getAttribute('uv').array];
    expect(most('plain')).toEqual([0, 0, 2, 0, 0, 3]);
    expect(most('own')).toEqual([0, 0, 0.25, 0, 0, 0.5]);
    expect([...cache.get({ ...shape, mesh: 'plain' }, [1, 1]).getAttribute('position').array]).toEqual([
      0, 0, 0, 1, 0, 0, 0, 0, 1,
    ]);
  });

  it('cover lids as seen from above', () => {
    const lid = new THREE.BufferGeometry();
    lid.setAttribute('position', new THREE.Float32BufferAttribute([0, 0, 1, 1, 0, 1, 0, 1, 1], 3));
    lid.setAttribute('normal', new THREE.Float32BufferAttribute([0, 0, 1, 0, 0, 1, 0, 0, 1], 3));
    mapPicture(lid, 'cylinder', [1, 1]);
    expect([...lid.getAttribute('uv').array]).toEqual([0, 0, 1, 0, 0, 1]);
  });
});
