import * as THREE from 'three';

/** The time in s in which the camera covers most of its distance to the robot. */
const SOFTNESS_S = 0.4;
const LONGEST_STEP_S = 0.2;
const NEAR_M = 1e-3;

/** Moves a camera after the robot smoothly: at each picture by a share of the remaining distance. */
export class Follower {
  private last: THREE.Vector3 | null = null;
  private readonly left = new THREE.Vector3();

  get isOn(): boolean {
    return this.last !== null;
  }

  /** Starts following. The camera first moves by `left`, which brings the robot to the middle. */
  begin(robot: THREE.Vector3, left?: THREE.Vector3): void {
    this.last = robot.clone();
    this.left.set(left?.x ?? 0, left?.y ?? 0, 0);
  }

  end(): void {
    this.last = null;
    this.left.set(0, 0, 0);
  }

  /** Returns the movement of the camera in this picture; null if it has arrived. */
  step(robot: THREE.Vector3, seconds: number): THREE.Vector3 | null {
    if (!this.last) return null;
    this.left.add(robot).sub(this.last).setZ(0);
    this.last.copy(robot);
    if (this.left.length() < NEAR_M) return null;
    const share = 1 - Math.exp(-Math.min(Math.max(seconds, 0), LONGEST_STEP_S) / SOFTNESS_S);
    const by = this.left.clone().multiplyScalar(share);
    this.left.sub(by);
    return by;
  }
}
