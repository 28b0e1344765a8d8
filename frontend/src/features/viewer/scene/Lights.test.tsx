import * as THREE from 'three';
import { describe, expect, it } from 'vitest';
import { objectsOf, showScene } from '../../../../harness/scene';
import { Lights } from './Lights';

const box = (size: number) => new THREE.Box3(new THREE.Vector3(), new THREE.Vector3(size, 0, 0));
const SUNS = [
  { direction: [0, 0, -1], intensity: 0.5 },
  { direction: [-1, 0, 0], intensity: 3 },
];

function lights(more: Partial<Parameters<typeof Lights>[0]> = {}) {
  const { scene } = showScene(
    <Lights scene={{ lights: SUNS }} bounds={box(20)} isDark={false} hasShadows {...more} />,
  );
  const [sky] = objectsOf(scene, THREE.HemisphereLight);
  return { sky: sky!, suns: objectsOf(scene, THREE.DirectionalLight) };
}

describe('Lights', () => {
  it('shine along their directions, from outside of the room', () => {
    const { suns } = lights();
    expect(suns.map(({ position }) => position.toArray().map((part) => Math.round(part) + 0))).toEqual([
      [0, 0, 20],
      [20, 0, 0],
    ]);
    expect(suns.map(({ intensity }) => intensity)).toEqual([1, 6]);
  });

  it.each([
    [1, 4],
    [20, 10],
    [500, 20],
  ])('cast shadows over a room of %s m, by the first of them', (size, half) => {
    const { suns } = lights({ bounds: box(size) });
    expect(suns.map(({ castShadow }) => castShadow)).toEqual([true, false]);
    const { left, right, top, bottom, near, far } = suns[0]!.shadow.camera;
    expect([left, right, top, bottom, near, far]).toEqual([-half, half, half, -half, 0.1, half * 5]);
    expect(suns[0]!.position.length()).toBeCloseTo(half * 2);
    expect(suns[0]!.shadow.mapSize.toArray()).toEqual([2048, 2048]);
    expect([suns[0]!.shadow.bias, suns[0]!.shadow.normalBias, suns[0]!.shadow.radius]).toEqual([
      -0.0004, 0.02, 5,
    ]);
  });

  it('cast none with software rendering', () => {
    expect(lights({ hasShadows: false }).suns.map(({ castShadow }) => castShadow)).toEqual([false, false]);
  });

  it('are weaker in the dark theme', () => {
    const { sky, suns } = lights({ isDark: true });
    expect(suns.map(({ intensity }) => intensity)).toEqual([0.75, 4.5]);
    expect([sky.intensity, sky.color.getHexString(), sky.groundColor.getHexString()]).toEqual([
      0.9,
      'b9c6e6',
      '2a2d36',
    ]);
    const day = lights().sky;
    expect([day.intensity, day.color.getHexString(), day.groundColor.getHexString()]).toEqual([
      1.35,
      'ffffff',
      'b9b4aa',
    ]);
    expect(day.position.toArray()).toEqual([0, 0, 1]);
  });

  it('are a sun if the world has none', () => {
    const { suns } = lights({ scene: { lights: [] } });
    expect(suns).toHaveLength(1);
    expect(suns[0]!.intensity).toBe(2);
    const towards = new THREE.Vector3(-0.3, -0.4, 0.8).normalize();
    expect(suns[0]!.position.clone().normalize().distanceTo(towards)).toBeLessThan(1e-6);
  });
});
