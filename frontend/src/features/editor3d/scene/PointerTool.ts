import type * as THREE from 'three';
import { snapped } from '@/model/universe/geometry';
import type { Point } from '@/model/document/values';
import { cancellable } from '@/ui/cancellable';
import { pointAt, thingAt, type Aimed } from './aiming';
import { isReadOnly, type Editor } from '../editing';
import type { ThingScene } from './ThingScene';

const CLICK_PX = 4;

/** The things that a drag moves over the floor. */
interface Load {
  readonly keys: readonly string[];
  /**
   * The position of the thing under the pointer, which snaps to the grid; the other things move by the same
   * offset.
   */
  readonly anchor: Point;
  readonly nodes: readonly THREE.Object3D[];
}

/** The handlers for dragging an editor's things with the pointer. */
export interface DragHandler {
  /** Returns the things to drag; null if the thing under the pointer cannot be dragged. */
  take(hit: Aimed): Load | null;
  drop(keys: readonly string[], by: Point): void;
  click(hit: Aimed | null, isAdding: boolean): void;
}

/** A tool that draws something point by point, in place of selecting. */
export interface Drawing {
  isOn(): boolean;
  /** The height in m at which the pointer draws. */
  height(): number;
  move(point: Point): void;
  click(point: Point | null, isAdding: boolean): void;
  /** Returns whether there was a gesture to end. */
  end(): boolean;
}

interface Parts {
  readonly editor: Editor;
  readonly scene: Pick<ThingScene<{ key: string }>, 'group' | 'keyOf'>;
  readonly dragHandler: DragHandler;
  readonly drawings: readonly Drawing[];
  readonly camera: THREE.Camera;
  readonly canvas: HTMLElement;
  /** Returns whether the gizmo handles the pointer now. */
  readonly isTaken: () => boolean;
  readonly hold: (isHeld: boolean) => void;
  readonly redraw: () => void;
}

interface Dragging extends Load {
  readonly from: Point;
  readonly height: number;
  readonly starts: readonly { readonly node: THREE.Object3D; readonly at: THREE.Vector3 }[];
  offset: Point;
}

/** The pointer on the floor plan: it selects, drags and draws. */
export class PointerTool {
  private pressed: { x: number; y: number; isFree: boolean } | null = null;
  private dragging: Dragging | null = null;
  private unfollow: (() => void) | null = null;
  private readonly listening = new AbortController();

  constructor(private readonly parts: Parts) {
    const { canvas } = parts;
    const { signal } = this.listening;
    canvas.addEventListener('pointerdown', this.onDown, { capture: true, signal });
    canvas.addEventListener('pointermove', this.onMove, { signal });
    canvas.addEventListener('pointerup', this.onUp, { signal });
  }

  /** Cancels the current gesture; returns whether there was one. */
  cancel(): boolean {
    const wasBusy = this.dragging !== null;
    for (const { node, at } of this.dragging?.starts ?? []) node.position.copy(at);
    this.letGo();
    this.parts.hold(false);
    this.parts.canvas.style.cursor = '';
    const ended = this.parts.drawings.filter((drawing) => drawing.end());
    this.parts.redraw();
    return wasBusy || ended.length > 0;
  }

  dispose(): void {
    this.letGo();
    this.listening.abort();
  }

  private letGo(): void {
    this.unfollow?.();
    this.unfollow = null;
    this.dragging = null;
    this.pressed = null;
  }

  private drawing(): Drawing | undefined {
    return this.parts.drawings.find((each) => each.isOn());
  }

  private readonly onDown = (event: PointerEvent): void => {
    const isDrawing = this.drawing() !== undefined;
    // Otherwise the press that cancels drawing would also move the view.
    if (event.button === 2 && isDrawing && this.cancel()) event.stopImmediatePropagation();
    if (event.button !== 0) return;
    if (this.parts.isTaken() && (isDrawing || !this.isOnAnother(event))) return;
    this.pressed = { x: event.clientX, y: event.clientY, isFree: true };
    if (isDrawing || isReadOnly()) return;
    if (!isAdding(event)) this.take(event);
  };

  /**
   * Returns whether the pointer is on an unselected thing that can be dragged; the thing then takes
   * precedence over the gizmo.
   */
  private isOnAnother(event: PointerEvent): boolean {
    const { scene, camera, canvas, dragHandler, editor } = this.parts;
    const hit = thingAt(event, canvas, camera, scene);
    if (!hit || hit.waypoint !== null || editor.store.getState().selection.includes(hit.key)) return false;
    return !isReadOnly() && !isAdding(event) && dragHandler.take(hit) !== null;
  }

  private take(event: PointerEvent): void {
    const { scene, camera, canvas, hold, dragHandler } = this.parts;
    const hit = thingAt(event, canvas, camera, scene);
    const load = hit ? dragHandler.take(hit) : null;
    const from = hit ? pointAt(event, canvas, camera, hit.height) : null;
    if (!hit || !load || !from) return;
    const starts = load.nodes.map((node) => ({ node, at: node.position.clone() }));
    this.dragging = { ...load, from, height: hit.height, starts, offset: [0, 0] };
    hold(true);
    canvas.setPointerCapture(event.pointerId);
    this.unfollow = cancellable(canvas, event.pointerId, {
      onMove: this.onDrag,
      onEnd: this.onUp,
      onCancel: () => this.cancel(),
    });
    event.stopImmediatePropagation();
    canvas.focus();
  }

  private readonly onMove = (event: PointerEvent): void => {
    if (this.dragging) return;
    const { scene, camera, canvas, redraw } = this.parts;
    const drawing = this.drawing();
    if (drawing) {
      const point = this.floorPoint(event, drawing);
      if (point) drawing.move(point);
      redraw();
    } else if (event.buttons === 0) {
      canvas.style.cursor = thingAt(event, canvas, camera, scene) ? 'pointer' : '';
    }
  };

  private readonly onDrag = (event: PointerEvent): void => {
    const { camera, canvas, redraw, editor } = this.parts;
    const { dragging } = this;
    if (!dragging || !this.isDragged(event)) return;
    const at = pointAt(event, canvas, camera, dragging.height);
    if (!at) return;
    canvas.style.cursor = 'grabbing';
    const { grid } = editor.store.getState();
    const along = (axis: 0 | 1) =>
      snapped(dragging.anchor[axis] + at[axis] - dragging.from[axis], grid) - dragging.anchor[axis];
    dragging.offset = [along(0), along(1)];
    const [dx, dy] = dragging.offset;
    for (const { node, at: start } of dragging.starts) node.position.set(start.x + dx, start.y + dy, start.z);
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
    const { dragging, pressed } = this;
    const { canvas, hold, dragHandler } = this.parts;
    const isClick = pressed !== null && !this.isDragged(event);
    this.letGo();
    if (dragging) hold(false);
    if (dragging && !isClick) {
      canvas.style.cursor = '';
      dragHandler.drop(dragging.keys, dragging.offset);
      return;
    }
    if (isClick && event.button === 0) this.click(event);
  };

  private click(event: PointerEvent): void {
    const { scene, camera, canvas, redraw, dragHandler } = this.parts;
    const drawing = this.drawing();
    if (!drawing) {
      dragHandler.click(thingAt(event, canvas, camera, scene), isAdding(event));
      return;
    }
    drawing.click(this.floorPoint(event, drawing), isAdding(event));
    redraw();
  }

  private floorPoint(event: PointerEvent, drawing: Drawing): Point | null {
    const { camera, canvas, editor } = this.parts;
    const { grid } = editor.store.getState();
    const point = pointAt(event, canvas, camera, drawing.height());
    return point ? [snapped(point[0], grid), snapped(point[1], grid)] : null;
  }
}

const isAdding = (event: PointerEvent): boolean => event.shiftKey || event.ctrlKey || event.metaKey;
