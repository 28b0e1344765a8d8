import * as THREE from 'three';
import { LineMaterial } from 'three/examples/jsm/lines/LineMaterial.js';
import { LineSegments2 } from 'three/examples/jsm/lines/LineSegments2.js';
import { LineSegmentsGeometry } from 'three/examples/jsm/lines/LineSegmentsGeometry.js';
import type { ShownPath } from '@/store/session/trace/shownPaths';
import { POINT_NUMBERS } from '@/store/session/trace/shownTrail';
import { LIFT_M } from '../scene/TrailView';

/** Each path lies a little above the one before, so that those at one place do not flicker. */
const LAYER_M = 0.004;
const WIDTH_PX = 4;
const DASH_M = 0.15;
const GAP_M = 0.1;
const DOT_M = 0.07;
const LABEL_PX = 64;
/** The height of a label as a share of the picture's. */
const LABEL_SIZE = 0.045;
const SATURATION = 0.7;
const DARK = { lightness: 0.7, text: 0xe9ebf1, halo: '#0e1015' };
const LIGHT = { lightness: 0.38, text: 0x161a22, halo: '#ffffff' };

interface Drawn {
  readonly labelAt: ShownPath['labelAt'];
  readonly points: Float32Array;
  readonly dot: THREE.Mesh;
  readonly label: THREE.Sprite | null;
}

/** Paths beside the trail: a line each, a dot where its robot is at the shown moment, and its label there. */
export class PathsView {
  readonly group = new THREE.Group();
  private drawn: Drawn[] = [];
  private readonly made: { dispose(): void }[] = [];

  /** Draws other paths. */
  show(paths: readonly ShownPath[], isDark: boolean, until: number | null): void {
    this.clear();
    const theme = isDark ? DARK : LIGHT;
    paths.forEach((path, layer) => {
      const color = new THREE.Color(theme.text);
      if (path.hue !== null) color.setHSL(path.hue / 360, SATURATION, theme.lightness);
      for (const points of path.lines) this.draw(path, points, color, layer, theme.halo);
    });
    this.move(until);
  }

  /** Moves the dots to where the robots were at a time in s; null: to the ends. */
  move(until: number | null): void {
    for (const { labelAt, points, dot, label } of this.drawn) {
      const at = placeAt(points, labelAt === 'end' ? null : until);
      dot.visible = at !== null;
      if (label) label.visible = at !== null;
      if (!at) continue;
      dot.position.set(at[0], at[1], DOT_M);
      label?.position.set(at[0], at[1], 4 * DOT_M);
    }
  }

  dispose(): void {
    this.clear();
  }

  private draw(path: ShownPath, points: Float32Array, color: THREE.Color, layer: number, halo: string): void {
    const geometry = new LineSegmentsGeometry();
    geometry.setPositions(segmentsOf(points, LIFT_M + (layer + 1) * LAYER_M));
    const dashes = { dashed: path.isDashed, dashSize: DASH_M, gapSize: GAP_M };
    const material = new LineMaterial({ linewidth: WIDTH_PX, ...dashes });
    material.color = color;
    const line = new LineSegments2(geometry, material);
    line.computeLineDistances();
    line.frustumCulled = false;
    const ball = new THREE.SphereGeometry(DOT_M, 12, 8);
    const paint = new THREE.MeshBasicMaterial({ color });
    const dot = new THREE.Mesh(ball, paint);
    const label = labelOf(path.label, color, halo);
    this.made.push(geometry, material, ball, paint);
    if (label) this.made.push(label.material, { dispose: () => label.material.map?.dispose() });
    this.group.add(line, dot, ...(label ? [label] : []));
    this.drawn.push({ labelAt: path.labelAt, points, dot, label });
  }

  private clear(): void {
    this.group.clear();
    for (const each of this.made.splice(0)) each.dispose();
    this.drawn = [];
  }
}

/** Returns the ends of the lines between the points of a path. */
function segmentsOf(points: Float32Array, height: number): Float32Array {
  const ends: number[] = [];
  for (let at = POINT_NUMBERS; at < points.length; at += POINT_NUMBERS) {
    const [fromX = 0, fromY = 0] = points.subarray(at - POINT_NUMBERS);
    const [x = 0, y = 0, , begins = 0] = points.subarray(at);
    if (begins !== 1) ends.push(fromX, fromY, height, x, y, height);
  }
  return Float32Array.from(ends);
}

/** Returns where a path is at a time; null before its begin. */
function placeAt(points: Float32Array, until: number | null): readonly [x: number, y: number] | null {
  let place: readonly [number, number] | null = null;
  for (let at = 0; at < points.length; at += POINT_NUMBERS) {
    const [x = 0, y = 0, t = 0] = points.subarray(at);
    if (until !== null && t > until) break;
    place = [x, y];
  }
  return place;
}

/** Returns a label that always faces the camera; null where the browser cannot draw text outside of the page. */
function labelOf(text: string, color: THREE.Color, halo: string): THREE.Sprite | null {
  if (typeof OffscreenCanvas === 'undefined') return null;
  const canvas = new OffscreenCanvas(LABEL_PX, LABEL_PX);
  const context = canvas.getContext('2d');
  if (!context) return null;
  context.font = `bold ${LABEL_PX * 0.7}px sans-serif`;
  context.textAlign = 'center';
  context.textBaseline = 'middle';
  context.lineWidth = LABEL_PX / 8;
  context.strokeStyle = halo;
  context.fillStyle = `#${color.getHexString()}`;
  context.strokeText(text, LABEL_PX / 2, LABEL_PX / 2, LABEL_PX);
  context.fillText(text, LABEL_PX / 2, LABEL_PX / 2, LABEL_PX);
  const map = new THREE.CanvasTexture(canvas);
  map.colorSpace = THREE.SRGBColorSpace;
  const sprite = new THREE.Sprite(
    new THREE.SpriteMaterial({ map, depthTest: false, sizeAttenuation: false }),
  );
  sprite.scale.setScalar(LABEL_SIZE);
  sprite.renderOrder = 4;
  return sprite;
}
