import * as THREE from 'three';
import { expect, it, vi } from 'vitest';
import { showScene } from '../../../../harness/scene';
import type { Orbit } from './Surroundings';
import { useFollow } from './useFollow';
import type { World } from './World';

it('reports when the user turns the camera, but not when the user zooms', () => {
  const orbit = Object.assign(new THREE.EventDispatcher<{ start: object; end: object }>(), {
    target: new THREE.Vector3(),
    object: new THREE.Object3D(),
  });
  orbit.object.position.set(4, 0, 3);
  const onMoved = vi.fn();
  const world = { robot: new THREE.Object3D() } as unknown as World;
  const controls = { current: orbit as unknown as Orbit };
  const view = {};
  function Following() {
    useFollow(world, controls, { isOn: true, view, onMoved, requestFrame: vi.fn() });
    return null;
  }
  showScene(<Following />);
  const gesture = (x: number, y: number, z: number) => {
    orbit.dispatchEvent({ type: 'start' });
    orbit.object.position.set(x, y, z);
    orbit.dispatchEvent({ type: 'end' });
  };
  gesture(8, 0, 6);
  expect(onMoved).not.toHaveBeenCalled();
  gesture(0, 8, 6);
  expect(onMoved).toHaveBeenCalledOnce();
});
