import type * as THREE from 'three';
import { LineMaterial } from 'three/examples/jsm/lines/LineMaterial.js';
import { LineSegments2 } from 'three/examples/jsm/lines/LineSegments2.js';
import { LineSegmentsGeometry } from 'three/examples/jsm/lines/LineSegmentsGeometry.js';
import { MAX_POINTS, type Trail } from '@/store/session/trace/trail';

const LIFT_M = 0.012;
const WIDTH_PX = 3;
const COLOR = 0xf59f00;

/** The path of the robot, drawn as a line of visible width. */
export class TrailView {
  readonly line: LineSegments2;
  private readonly segments = new Float32Array(MAX_POINTS * 6);
  private readonly geometry = new LineSegmentsGeometry();
  private shown = -1;

  constructor(private readonly trail: Trail) {
    this.geometry.setPositions(this.segments);
    this.line = new LineSegments2(this.geometry, new LineMaterial({ color: COLOR, linewidth: WIDTH_PX }));
    this.line.frustumCulled = false;
    this.update();
  }

  /** Applies the current trail; returns whether it has changed. */
  update(): boolean {
    const { trail, segments } = this;
    if (trail.version === this.shown) return false;
    this.shown = trail.version;
    const count = Math.max(trail.count - 1, 0);
    for (let i = 0; i < count; i++) {
      const at = i * 6;
      segments[at] = trail.x(i);
      segments[at + 1] = trail.y(i);
      segments[at + 2] = LIFT_M;
      segments[at + 3] = trail.x(i + 1);
      segments[at + 4] = trail.y(i + 1);
      segments[at + 5] = LIFT_M;
    }
    const start = this.geometry.getAttribute('instanceStart') as THREE.InterleavedBufferAttribute;
    start.data.set(segments.subarray(0, count * 6));
    start.data.needsUpdate = true;
    this.geometry.instanceCount = count;
    this.line.visible = count > 0;
    return true;
  }

  dispose(): void {
    this.geometry.dispose();
    this.line.material.dispose();
  }
}
