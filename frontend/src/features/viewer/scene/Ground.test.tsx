import { act } from '@testing-library/react';
import * as THREE from 'three';
import { describe, expect, it, vi } from 'vitest';
import { objectsOf, showScene } from '../../../../harness/scene';
import { Ground } from './Ground';
import type { Pictures } from './TextureCache';

type Floor = THREE.Mesh<THREE.PlaneGeometry, THREE.MeshStandardMaterial>;

function ground(more: Partial<Parameters<typeof Ground>[0]> = {}) {
  const element = (props: typeof more) => (
    <Ground color={[1, 0.5, 0, 1]} isDark={false} isSimple={false} {...props} />
  );
  const { scene, rerender } = showScene(element(more));
  return {
    floor: () => objectsOf(scene, THREE.Mesh)[0] as Floor,
    change: (next: typeof more) => rerender(element(next)),
  };
}

describe('Ground', () => {
  it('is a wide floor, a little below everything that is on it', () => {
    const { floor } = ground();
    expect(floor().position.z).toBe(-0.002);
    expect(floor().receiveShadow).toBe(true);
    expect(floor().geometry.parameters).toMatchObject({ width: 200, height: 200 });
    expect(floor().material.color.getHexString()).toBe('ff8000');
    expect([floor().material.roughness, floor().material.metalness]).toEqual([0.95, 0]);
    expect(floor().material.map).toBeNull();
  });

  it('is darker in the dark theme', () => {
    const day = ground().floor().material.color;
    const night = ground({ isDark: true }).floor().material.color;
    expect(night.r).toBeCloseTo(day.r / 5);
    expect(night.g).toBeCloseTo(day.g / 5);
  });

  it('is grey without a colour, and simple with software rendering', () => {
    const { floor } = ground({ color: [], isSimple: true });
    expect(floor().material).toBeInstanceOf(THREE.MeshLambertMaterial);
    expect(floor().material.color.getHexString()).toBe('cccccc');
  });

  it('repeats its picture from the origin of the world', () => {
    let take: ((texture: THREE.Texture) => void) | undefined;
    const textures: Pictures = {
      whenLoaded: (name, taken) => {
        if (name === 'wood') take = taken;
      },
      tileOf: () => [2, 0.5],
      dispose: () => undefined,
    };
    const { floor, change } = ground({ textures, picture: 'wood' });
    expect(floor().material.map).toBeNull();
    const shared = new THREE.Texture();
    act(() => take?.(shared));
    const own = floor().material.map!;
    expect(own).not.toBe(shared);
    expect(own.repeat.toArray()).toEqual([100, 400]);
    expect(own.offset.toArray()).toEqual([-50, -200]);
    const freed = vi.fn();
    own.addEventListener('dispose', freed);
    change({ textures, picture: 'brick' });
    expect(floor().material.map).toBeNull();
    expect(freed).toHaveBeenCalled();
    act(() => take?.(shared));
    expect(floor().material.map).toBeNull();
  });
});
