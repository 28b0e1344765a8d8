import { createRef, type ComponentProps } from 'react';
import * as THREE from 'three';
import { describe, expect, it, vi } from 'vitest';
import { cameraAbove, objectsOf, showScene } from '../../../../harness/scene';
import { look, Surroundings, useSight, type Orbit } from './Surroundings';

const ROOM = new THREE.Box3(new THREE.Vector3(-2, -4, 0), new THREE.Vector3(4, 4, 2));

function surroundings(more: Partial<ComponentProps<typeof Surroundings>> = {}) {
  const controls = createRef<Orbit>();
  const { scene } = showScene(
    <Surroundings
      controls={controls}
      isDark={false}
      lights={[{ direction: [0, 0, -1], intensity: 1 }]}
      bounds={ROOM}
      ground={{ color: [1, 1, 1] }}
      hasGrid
      reach={[0.5, 60]}
      {...more}
    >
      <group name="inside" />
    </Surroundings>,
  );
  const grids = objectsOf(scene, THREE.GridHelper).map((grid) => {
    const { opacity, transparent } = grid.material as THREE.Material;
    const side = new THREE.Box3().setFromObject(grid).max.x * 2;
    const lines = grid.geometry.getAttribute('position').count / 4 - 1;
    return { side, step: side / lines, z: grid.position.z, opacity, transparent };
  });
  return { scene, controls: controls.current!, grids };
}

describe('the surroundings of a world', () => {
  it('are sky, fog, light and ground, with the content', () => {
    const { scene } = surroundings();
    expect((scene.background as THREE.Color).getHexString()).toBe('e6ebf3');
    expect(scene.fog).toMatchObject({ near: 30, far: 90 });
    expect(objectsOf(scene, THREE.DirectionalLight)[0]?.castShadow).toBe(true);
    expect(objectsOf(scene, THREE.Mesh)).toHaveLength(1);
    expect(scene.getObjectByName('inside')).toBeDefined();
  });

  it('are dark in the dark theme', () => {
    expect((surroundings({ isDark: true }).scene.background as THREE.Color).getHexString()).toBe('151922');
  });

  it('have a grid of a metre', () => {
    expect(surroundings().grids).toEqual([
      { side: 40, step: 1, z: 0.0035, opacity: 0.45, transparent: true },
    ]);
    expect(surroundings({ hasGrid: false }).grids).toEqual([]);
  });

  it.each([
    [0.5, 20, 0.3],
    [0.05, 10, 0.22],
  ])('have finer lines of %s m on request', (fineGrid, side, opacity) => {
    const { grids } = surroundings({ fineGrid });
    expect(grids).toHaveLength(2);
    expect(grids[1]).toMatchObject({ z: 0.003, opacity });
    expect(grids[1]!.side).toBeCloseTo(side);
    expect(grids[1]!.step).toBeCloseTo(fineGrid);
  });

  it.each([0, 1, 2])('have none of %s m', (fineGrid) => {
    expect(surroundings({ fineGrid }).grids).toHaveLength(1);
  });

  it('can be turned down to the ground, and within the distances', () => {
    const { controls } = surroundings();
    expect(controls).toMatchObject({ minDistance: 0.5, maxDistance: 60, enableDamping: true });
    expect(controls.maxPolarAngle).toBeCloseTo(Math.PI / 2 - 0.02);
  });
});

describe('look', () => {
  const sight = { bounds: ROOM, least: 1, most: 100, kind: 'default' as const };
  const diagonal = Math.hypot(6, 8, 2);
  const round = (vector: THREE.Vector3) => vector.toArray().map((part) => Math.round(part * 1e3) / 1e3);

  function orbit(camera: THREE.Camera) {
    const controls = { target: new THREE.Vector3(1, 1, 0), enableDamping: true, update: vi.fn() };
    return {
      controls,
      look: (more: object) => look(camera, controls as unknown as Orbit, { ...sight, ...more }),
    };
  }

  it('shows all from the side', () => {
    const camera = cameraAbove();
    const { controls, look: to } = orbit(camera);
    to({});
    expect(round(controls.target)).toEqual([1, 0, 1]);
    const side = new THREE.Vector3(-0.62, -0.42, 0.58).normalize();
    expect(round(camera.position.clone().sub(controls.target).normalize())).toEqual(round(side));
    camera.lookAt(controls.target);
    camera.updateMatrixWorld(true);
    for (const corner of [ROOM.min, ROOM.max]) {
      const shown = corner.clone().project(camera);
      expect(Math.max(Math.abs(shown.x), Math.abs(shown.y))).toBeLessThan(1);
    }
    expect(controls.update).toHaveBeenCalled();
    expect(controls.enableDamping).toBe(true);
  });

  it('shows all from above, with x up', () => {
    const camera = cameraAbove();
    orbit(camera).look({ kind: 'top' });
    expect(camera.position.x).toBeCloseTo(1 - 0.001);
    expect(camera.position.y).toBeCloseTo(0);
    expect(camera.position.z).toBeCloseTo(0.2 + 1.05 * diagonal);
  });

  it('shows a selection from the current direction, at its own height', () => {
    const camera = cameraAbove();
    camera.position.set(1, 1, 20);
    const { controls, look: to } = orbit(camera);
    to({ kind: 'selection' });
    expect(round(controls.target)).toEqual([1, 0, 1]);
    expect(camera.position.distanceTo(controls.target)).toBeCloseTo(1.6 * diagonal);
    expect(camera.position.x).toBeCloseTo(1);
    expect(camera.position.y).toBeCloseTo(0);
  });

  it('stops the inertia of a gesture', () => {
    const damped: boolean[] = [];
    const { controls, look: to } = orbit(cameraAbove());
    controls.update.mockImplementation(() => damped.push(controls.enableDamping));
    to({});
    expect(damped).toEqual([false, true]);
  });

  it.each([
    [{ least: 30 }, 30],
    [{ most: 4 }, 4],
  ])('keeps the visible size within %o', (limits, size) => {
    const camera = cameraAbove();
    orbit(camera).look({ ...limits, kind: 'top' });
    expect(camera.position.z).toBeCloseTo(0.2 + 1.05 * size);
  });

  it('shows the origin of an empty world, also without controls', () => {
    const camera = cameraAbove();
    look(camera, null, { ...sight, bounds: new THREE.Box3(), kind: 'top' });
    expect(camera.position.x).toBeCloseTo(-0.001);
    expect(camera.position.z).toBeCloseTo(1.05);
  });
});

describe('useSight', () => {
  it('moves the camera for another request only', async () => {
    const sight = vi.fn(() => ({ bounds: ROOM, least: 1, most: 10, kind: 'top' as const }));
    const controls = createRef<Orbit>();
    function Sight({ request }: { readonly request: object }) {
      useSight(controls, request, sight);
      return null;
    }
    const first = {};
    const { camera, rerender, frames } = showScene(<Sight request={first} />);
    expect(sight).toHaveBeenCalledOnce();
    expect(camera.position.z).toBeCloseTo(0.2 + 10.5);
    await vi.waitFor(() => expect(frames()).toBeGreaterThan(0));
    rerender(<Sight request={first} />);
    expect(sight).toHaveBeenCalledOnce();
    rerender(<Sight request={{}} />);
    expect(sight).toHaveBeenCalledTimes(2);
  });
});
