import * as THREE from 'three';
import type { Scan } from '@/generated/messages';
import { floatsOf } from '@/store/session/frames';

const HIT_COLOR = 0xe8443a;
const RAY_COLOR = 0x4f7cff;

/** The last LIDAR scan: faint rays, with a dot where a ray hit something. */
export class LidarView {
  readonly group = new THREE.Group();
  private readonly rays = new THREE.LineSegments(
    new THREE.BufferGeometry(),
    new THREE.LineBasicMaterial({ color: RAY_COLOR, transparent: true, opacity: 0.22, depthWrite: false }),
  );
  private readonly hits = new THREE.Points(
    new THREE.BufferGeometry(),
    new THREE.PointsMaterial({ color: HIT_COLOR, size: 5, sizeAttenuation: false }),
  );

  constructor() {
    this.rays.frustumCulled = false;
    this.hits.frustumCulled = false;
    this.group.add(this.rays, this.hits);
  }

  show(scan: Scan): void {
    const ranges = floatsOf(scan.ranges);
    const lines = new Float32Array(ranges.length * 6);
    const dots = new Float32Array(ranges.length * 3);
    let hitCount = 0;
    ranges.forEach((range, index) => {
      const isHit = Number.isFinite(range) && range > 0 && range < scan.range_max;
      const length = isHit ? range : scan.range_max;
      const angle = scan.angle_min + index * scan.angle_increment;
      const x = Math.cos(angle) * length;
      const y = Math.sin(angle) * length;
      lines.set([0, 0, 0, x, y, 0], index * 6);
      if (isHit) dots.set([x, y, 0], 3 * hitCount++);
    });
    this.fill(this.rays.geometry, lines);
    this.fill(this.hits.geometry, dots.subarray(0, hitCount * 3));
    const [x = 0, y = 0, z = 0, qx = 0, qy = 0, qz = 0, qw = 1] = scan.pose;
    this.group.position.set(x, y, z);
    this.group.quaternion.set(qx, qy, qz, qw);
  }

  dispose(): void {
    for (const part of [this.rays, this.hits]) {
      part.geometry.dispose();
      (part.material as THREE.Material).dispose();
    }
  }

  private fill(geometry: THREE.BufferGeometry, values: Float32Array): void {
    const old = geometry.getAttribute('position') as THREE.BufferAttribute | undefined;
    if (old && old.array.length >= values.length) {
      (old.array as Float32Array).set(values);
      old.needsUpdate = true;
      geometry.setDrawRange(0, values.length / 3);
      return;
    }
    geometry.setAttribute('position', new THREE.BufferAttribute(values.slice(), 3));
    geometry.setDrawRange(0, values.length / 3);
  }
}
