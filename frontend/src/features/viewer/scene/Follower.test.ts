import * as THREE from 'three';
import { describe, expect, it } from 'vitest';
import { Follower } from './Follower';

const at = (x: number, z = 0) => new THREE.Vector3(x, 0, z);

/**
 * Returns the distance that the camera moves along x in a number of pictures, while the robot stays in place.
 */
function wayTo(follower: Follower, robot: THREE.Vector3, pictures: number): number {
  let way = 0;
  for (let count = 0; count < pictures; count += 1) way += follower.step(robot, 1 / 30)?.x ?? 0;
  return way;
}

describe('a camera that follows', () => {
  it('follows the robot smoothly, and arrives', () => {
    const follower = new Follower();
    follower.begin(at(0));
    const first = wayTo(follower, at(1), 1);
    expect(first).toBeGreaterThan(0.01);
    expect(first).toBeLessThan(0.2);
    expect(first + wayTo(follower, at(1), 200)).toBeCloseTo(1, 2);
    expect(follower.step(at(1), 1 / 30)).toBeNull();
  });

  it('stays at its height', () => {
    const follower = new Follower();
    follower.begin(at(0));
    expect(follower.step(at(1, 5), 0.1)?.z).toBe(0);
  });

  it('first moves the robot to the middle', () => {
    const follower = new Follower();
    follower.begin(at(3), at(-2));
    expect(wayTo(follower, at(3), 200)).toBeCloseTo(-2, 2);
  });

  it('does not follow before it starts, or after it ended', () => {
    const follower = new Follower();
    expect([follower.isOn, follower.step(at(1), 0.1)]).toEqual([false, null]);
    follower.begin(at(1));
    follower.end();
    expect([follower.isOn, follower.step(at(5), 0.1)]).toEqual([false, null]);
  });
});
