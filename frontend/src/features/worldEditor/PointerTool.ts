import * as THREE from 'three';
import { move } from '@/model/universe/edits';
import { positionOf, snapped } from '@/model/universe/geometry';
import { type Point } from '@/model/document/values';
import { thingOf } from '@/model/universe/types';
import { pointAt, thingAt } from './aiming';
import { placeWall } from './commands';
import { edit, isReadOnly, readingOf, select, toggle, type UniverseEditor } from './editor';
import type { EditorScene } from './EditorScene';
import type { WallLine } from './WallLine';

const CLICK_PX = 4;
/** Wider things are floors and rooms: they are carried only once they are selected. */
const LARGEST_M = 3;

interface Parts {
  readonly editor: UniverseEditor;
  readonly scene: EditorScene;
  readonly wall: WallLine;
  readonly camera: THREE.Camera;
  readonly canvas: HTMLElement;
  /** Whether the gizmo has the pointer. */
  readonly isTaken: () => boolean;
  readonly hold: (isHeld: boolean) => void;
  readonly redraw: () => void;
}

interface Carrying {
  readonly keys: readonly string[];
  readonly from: Point;
  readonly height: number;
  /** Where the thing under the pointer is: its place falls on the grid, and the others follow. */
  readonly anchor: Point;
  readonly starts: ReadonlyMap<string, THREE.Vector3>;
  offset: Point;
}

/** What the pointer does on the floor plan: selects, carries, and draws walls. */
export class PointerTool {
  private pressed: { x: number; y: number; isFree: boolean } | null = null;
  private carrying: Carrying | null = null;
  private wallFrom: Point | null = null;
  private readonly listening = new AbortController();

  constructor(private readonly parts: Parts) {
    const { canvas } = parts;
    const { signal } = this.listening;
    canvas.addEventListener('pointerdown', this.onDown, { capture: true, signal });
    canvas.addEventListener('pointermove', this.onMove, { signal });
    canvas.addEventListener('pointerup', this.onUp, { signal });
    canvas.addEventListener('pointercancel', () => this.cancel(), { signal });
  }

  /** Ends what is under way without doing it; tells whether there was something. */
  cancel(): boolean {
    const wasBusy = this.carrying !== null || this.wallFrom !== null;
    this.putBack();
    this.carrying = null;
    this.wallFrom = null;
    this.pressed = null;
    this.parts.wall.hide();
    this.parts.hold(false);
    this.parts.redraw();
    return wasBusy;
  }

  dispose(): void {
    this.listening.abort();
  }

  private readonly onDown = (event: PointerEvent): void => {
    if (event.button !== 0 || this.parts.isTaken()) return;
    this.pressed = { x: event.clientX, y: event.clientY, isFree: true };
    if (this.parts.editor.store.getState().tool === 'wall' || isReadOnly()) return;
    if (!event.shiftKey && !event.ctrlKey && !event.metaKey) this.take(event);
  };

  private take(event: PointerEvent): void {
    const { editor, scene, camera, canvas, hold } = this.parts;
    const hit = thingAt(event, canvas, camera, scene);
    const { universe } = readingOf(editor);
    const thing = hit && universe ? thingOf(universe, hit.key) : undefined;
    if (!hit || !thing || hit.waypoint !== null) return;
    const { selection } = editor.store.getState();
    const isSelected = selection.includes(hit.key);
    if (!isSelected && this.isLarge(hit.key)) return;
    const from = pointAt(event, canvas, camera, hit.height);
    if (!from) return;
    const keys = isSelected ? selection : [hit.key];
    const starts = new Map(
      keys.map((key) => [key, scene.nodeOf(key)?.position.clone() ?? new THREE.Vector3()]),
    );
    this.carrying = { keys, from, height: hit.height, anchor: positionOf(thing), starts, offset: [0, 0] };
    hold(true);
    canvas.setPointerCapture(event.pointerId);
    event.stopImmediatePropagation();
    canvas.focus();
  }

  private isLarge(key: string): boolean {
    const node = this.parts.scene.nodeOf(key);
    if (!node) return true;
    const size = new THREE.Box3().setFromObject(node).getSize(new THREE.Vector3());
    return Math.max(size.x, size.y) > LARGEST_M;
  }

  private readonly onMove = (event: PointerEvent): void => {
    const { editor, scene, camera, canvas, wall, redraw } = this.parts;
    const { grid, tool } = editor.store.getState();
    if (tool === 'wall') {
      const point = this.floorPoint(event);
      if (point) wall.show(this.wallFrom, point);
      redraw();
      return;
    }
    const { carrying } = this;
    if (!carrying) {
      if (event.buttons === 0) canvas.style.cursor = thingAt(event, canvas, camera, scene) ? 'pointer' : '';
      return;
    }
    if (!this.isDragged(event)) return;
    const at = pointAt(event, canvas, camera, carrying.height);
    if (!at) return;
    canvas.style.cursor = 'grabbing';
    const along = (axis: 0 | 1) =>
      snapped(carrying.anchor[axis] + at[axis] - carrying.from[axis], grid) - carrying.anchor[axis];
    carrying.offset = [along(0), along(1)];
    for (const [key, start] of carrying.starts) {
      scene.nodeOf(key)?.position.set(start.x + carrying.offset[0], start.y + carrying.offset[1], start.z);
    }
    redraw();
  };

  private isDragged(event: PointerEvent): boolean {
    if (!this.pressed) return false;
    if (Math.hypot(event.clientX - this.pressed.x, event.clientY - this.pressed.y) >= CLICK_PX) {
      this.pressed.isFree = false;
    }
    return !this.pressed.isFree;
  }

  private readonly onUp = (event: PointerEvent): void => {
    const { carrying, pressed } = this;
    const { editor, canvas, hold } = this.parts;
    const isClick = pressed !== null && !this.isDragged(event);
    this.carrying = null;
    this.pressed = null;
    if (carrying) hold(false);
    if (carrying && !isClick) {
      canvas.style.cursor = '';
      const [dx, dy] = carrying.offset;
      if (!carrying.keys.every((key) => editor.store.getState().selection.includes(key)))
        select(editor, carrying.keys);
      edit(editor, 'move', (universe) => move(universe, carrying.keys, [dx, dy, 0]));
      return;
    }
    if (isClick && event.button === 0) this.click(event);
  };

  private click(event: PointerEvent): void {
    const { editor, scene, camera, canvas, redraw } = this.parts;
    if (editor.store.getState().tool === 'wall') {
      const point = this.floorPoint(event);
      if (point && this.wallFrom) placeWall(editor, this.wallFrom, point);
      this.wallFrom = point;
      redraw();
      return;
    }
    const hit = thingAt(event, canvas, camera, scene);
    if (!hit) select(editor, []);
    else if (event.shiftKey || event.ctrlKey || event.metaKey) toggle(editor, hit.key);
    else select(editor, [hit.key], hit.waypoint);
  }

  private floorPoint(event: PointerEvent): Point | null {
    const { camera, canvas, editor } = this.parts;
    const { grid } = editor.store.getState();
    const point = pointAt(event, canvas, camera);
    return point ? [snapped(point[0], grid), snapped(point[1], grid)] : null;
  }

  private putBack(): void {
    for (const [key, start] of this.carrying?.starts ?? []) {
      this.parts.scene.nodeOf(key)?.position.copy(start);
    }
  }
}
