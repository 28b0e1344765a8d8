import * as THREE from 'three';
import { describe, expect, it, vi } from 'vitest';
import * as settings from './three';

describe('three.js', () => {
  it('has z upwards everywhere after an import', () => {
    expect(Object.keys(settings)).toEqual([]);
    expect(new THREE.Object3D().up.toArray()).toEqual([0, 0, 1]);
  });

  it('reports errors in the console, but no warning about its clock', () => {
    const warned = vi.spyOn(console, 'warn').mockImplementation(() => undefined);
    new THREE.Clock();
    expect(warned).not.toHaveBeenCalled();
    new THREE.Material().setValues({ colour: 1 } as never);
    expect(warned).toHaveBeenCalledOnce();
    expect(warned.mock.lastCall?.[0]).toContain("'colour' is not a property of THREE.Material");
  });
});
