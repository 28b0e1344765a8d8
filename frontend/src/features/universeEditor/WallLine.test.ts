import * as THREE from 'three';
import { describe, expect, it } from 'vitest';
import { WallLine } from './WallLine';

const parts = (line: WallLine) => line.group.children as [THREE.Mesh, THREE.Mesh];

describe('WallLine', () => {
  it('is hidden until the pointer comes, and then a point', () => {
    const line = new WallLine();
    expect(line.group.visible).toBe(false);
    line.show(null, [1, 2]);
    const [wall, tip] = parts(line);
    expect(line.group.visible).toBe(true);
    expect(wall.visible).toBe(false);
    expect(tip.position.toArray()).toEqual([1, 2, 0.02]);
    line.hide();
    expect(line.group.visible).toBe(false);
  });

  it('stands between two corners, half a thickness longer at each end', () => {
    const line = new WallLine();
    line.show([1, 1], [1, 4]);
    const [wall] = parts(line);
    expect(wall.visible).toBe(true);
    expect(wall.position.toArray()).toEqual([1, 2.5, 0.5]);
    expect(wall.rotation.z).toBeCloseTo(Math.PI / 2);
    expect(wall.scale.x).toBeCloseTo(3.15);
    const box = new THREE.Box3().setFromObject(wall);
    expect(box.min.toArray().map((part) => Math.round(part * 1000) / 1000)).toEqual([0.925, 0.925, 0]);
    expect(box.max.z).toBeCloseTo(1);
  });

  it('is a point again over its own beginning', () => {
    const line = new WallLine();
    line.show([1, 1], [1.005, 1]);
    expect(parts(line)[0].visible).toBe(false);
  });

  it('frees what it drew', () => {
    const line = new WallLine();
    const [wall, tip] = parts(line);
    const freed: string[] = [];
    wall.geometry.addEventListener('dispose', () => freed.push('wall'));
    tip.geometry.addEventListener('dispose', () => freed.push('tip'));
    (wall.material as THREE.Material).addEventListener('dispose', () => freed.push('material'));
    line.dispose();
    expect(freed).toEqual(['wall', 'tip', 'material']);
  });
});
