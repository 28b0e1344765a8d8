import type * as THREE from 'three';
import { LineMaterial } from 'three/examples/jsm/lines/LineMaterial.js';
import { LineSegments2 } from 'three/examples/jsm/lines/LineSegments2.js';
import { LineSegmentsGeometry } from 'three/examples/jsm/lines/LineSegmentsGeometry.js';
import type { ShownTrail } from '@/store/session/trace/shownTrail';
import { MAX_POINTS } from '@/store/session/trace/trail';

export const LIFT_M = 0.012;
const WIDTH_PX = 3;
const COLOR = 0xf59f00;

/** The path of the robot, drawn as a line of visible width. */
export class TrailView {
  readonly line: LineSegments2;
  private readonly segments = new Float32Array(MAX_POINTS * 6);
  private readonly geometry = new LineSegmentsGeometry();
  private shown = '';

  constructor(private readonly trail: ShownTrail) {
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
    const path = trail.shown();
    const count = Math.max(path.length - 1, 0);
    path.slice(1).forEach(([x, y], i) => {
      const [fromX, fromY] = path[i] ?? [x, y];
      segments.set([fromX, fromY, LIFT_M, x, y, LIFT_M], i * 6);
    });
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
