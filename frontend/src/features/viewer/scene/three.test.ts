import * as THREE from 'three';
import { describe, expect, it, vi } from 'vitest';
import * as settings from './three';

describe('three.js', () => {
  it('has z upwards everywhere, by an import alone', () => {
    expect(Object.keys(settings)).toEqual([]);
    expect(new THREE.Object3D().up.toArray()).toEqual([0, 0, 1]);
  });

  it('says in the console what is wrong, but nothing of its clock', () => {
    const warned = vi.spyOn(console, 'warn').mockImplementation(() => undefined);
    new THREE.Clock();
    expect(warned).not.toHaveBeenCalled();
    new THREE.Material().setValues({ colour: 1 } as never);
    expect(warned).toHaveBeenCalledOnce();
    expect(warned.mock.lastCall?.[0]).toContain("'colour' is not a property of THREE.Material");
  });
});
