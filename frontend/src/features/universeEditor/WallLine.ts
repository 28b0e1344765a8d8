import * as THREE from 'three';
import type { Point } from '@/model/document/values';

/** The preview of the wall that the next click builds. */
export class WallLine {
  readonly group = new THREE.Group();
  private readonly wall: THREE.Mesh;
  private readonly tip: THREE.Mesh;

  constructor() {
    const material = new THREE.MeshBasicMaterial({ color: 0x6f7dff, transparent: true, opacity: 0.55 });
    this.wall = new THREE.Mesh(new THREE.BoxGeometry(1, 0.15, 1), material);
    this.tip = new THREE.Mesh(
      new THREE.CylinderGeometry(0.07, 0.07, 0.02, 20).rotateX(Math.PI / 2),
      material,
    );
    this.group.add(this.wall, this.tip);
    this.hide();
  }

  show(from: Point | null, [x, y]: Point): void {
    this.group.visible = true;
    this.tip.position.set(x, y, 0.02);
    const length = from ? Math.hypot(x - from[0], y - from[1]) : 0;
    this.wall.visible = from !== null && length > 0.01;
    if (!from) return;
    this.wall.position.set((from[0] + x) / 2, (from[1] + y) / 2, 0.5);
    this.wall.rotation.z = Math.atan2(y - from[1], x - from[0]);
    this.wall.scale.x = Math.max(length + 0.15, 0.01);
  }

  hide(): void {
    this.group.visible = false;
  }

  dispose(): void {
    this.wall.geometry.dispose();
    this.tip.geometry.dispose();
    (this.wall.material as THREE.Material).dispose();
  }
}
