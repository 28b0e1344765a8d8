import * as THREE from 'three';

const MAX_POINTS = 6000;
const STEP_M = 0.03;
const LIFT_M = 0.012;
const FASTEST_M_S = 5;

/** Where the robot has been. */
export class TrailView {
  readonly line: THREE.Line;
  private readonly points = new Float32Array(MAX_POINTS * 3);
  private readonly attribute = new THREE.BufferAttribute(this.points, 3);
  private count = 0;
  private lastTime = 0;
  private readonly last = new THREE.Vector3(Infinity, 0, 0);

  constructor() {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', this.attribute);
    geometry.setDrawRange(0, 0);
    this.line = new THREE.Line(
      geometry,
      new THREE.LineBasicMaterial({ color: 0xf59f00, transparent: true, opacity: 0.95 }),
    );
    this.line.frustumCulled = false;
  }

  /** Adds where the robot was at a simulated time. */
  add(position: THREE.Vector3, t: number): void {
    const step = this.last.distanceTo(position);
    const passed = t - this.lastTime;
    // Time went back or the robot was put somewhere else: the old way does not lead there.
    if (passed < 0 || (this.count > 0 && step > Math.max(STEP_M, passed * FASTEST_M_S))) this.count = 0;
    else if (step < STEP_M) return;
    this.lastTime = t;
    this.last.copy(position);
    if (this.count === MAX_POINTS) {
      this.points.copyWithin(0, MAX_POINTS * 1.5, MAX_POINTS * 3);
      this.count = MAX_POINTS / 2;
    }
    this.points.set([position.x, position.y, LIFT_M], this.count * 3);
    this.count += 1;
    this.attribute.needsUpdate = true;
    this.line.geometry.setDrawRange(0, this.count);
  }

  dispose(): void {
    this.line.geometry.dispose();
    (this.line.material as THREE.Material).dispose();
  }
}
