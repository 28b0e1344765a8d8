import type * as THREE from 'three';
import type { Point } from '@/model/document/values';
import { snapped } from '@/model/universe/geometry';
import type { Editor, Placer } from '../editing';
import { pointAt } from './aiming';
import type { Drawing } from './PointerTool';
import type { ThingScene } from './ThingScene';

/** The opacity of a thing that is not placed yet. */
export const GHOST_OPACITY = 0.5;

/** The place of a thing, and the height in m at which the pointer holds it. */
interface Spot {
  readonly at: Point;
  readonly height: number;
}

/** The functions of an editor that draw and place the chosen thing. */
export interface Placement {
  /** The scene that contains only the ghost. */
  readonly scene: Pick<ThingScene<{ key: string }>, 'group'>;
  /**
   * Draws a thing at its default place, or removes the ghost for null; returns null for a thing without a
   * ghost.
   */
  draw(what: object | null): Spot | null;
  /** Adds the thing to the document: at a point, or at its default place. */
  place(what: object, at?: Point): void;
}

interface Parts {
  readonly editor: Editor;
  readonly placement: Placement;
  readonly camera: THREE.Camera;
  readonly canvas: HTMLElement;
  readonly redraw: () => void;
}

/**
 * Places the chosen thing: its ghost follows the pointer on the grid, and a click or Enter places it there.
 */
export class PlacingTool implements Drawing, Placer {
  private spot: Spot | null = null;
  /** The place to which the user moved the ghost; null while the ghost is at its default place. */
  private at: Point | null = null;

  constructor(private readonly parts: Parts) {}

  isOn(): boolean {
    return this.parts.editor.store.getState().placing !== null;
  }

  height(): number {
    return this.spot?.height ?? 0;
  }

  /** Draws the ghost of the thing that is chosen now. */
  show(): void {
    const { editor, placement, canvas, redraw } = this.parts;
    const { placing } = editor.store.getState();
    this.at = null;
    this.spot = placement.draw(placing?.what ?? null);
    placement.scene.group.position.set(0, 0, 0);
    canvas.style.cursor = placing ? 'crosshair' : '';
    redraw();
    // A thing without a ghost is placed at once; if the document cannot be changed, this reports the reason.
    if (placing && !this.spot) this.put(false);
  }

  move(point: Point): void {
    const { placement, redraw } = this.parts;
    if (!this.spot) return;
    const [x, y] = this.spot.at;
    this.at = point;
    placement.scene.group.position.set(point[0] - x, point[1] - y, 0);
    redraw();
  }

  click(point: Point | null, isMore: boolean): void {
    if (!point) return;
    this.move(point);
    this.put(isMore);
  }

  end(): boolean {
    const wasOn = this.isOn();
    if (wasOn) this.parts.editor.store.setState({ placing: null });
    return wasOn;
  }

  aim(event: Pick<MouseEvent, 'clientX' | 'clientY'>): boolean {
    const { canvas, camera, editor } = this.parts;
    const { left, right, top, bottom } = canvas.getBoundingClientRect();
    const { clientX: x, clientY: y } = event;
    if (x < left || x > right || y < top || y > bottom) return false;
    const point = pointAt(event, canvas, camera, this.height());
    const { grid } = editor.store.getState();
    if (point) this.move([snapped(point[0], grid), snapped(point[1], grid)]);
    return point !== null;
  }

  shift([dx, dy]: Point): void {
    const [x, y] = this.at ?? this.spot?.at ?? [0, 0];
    this.move([x + dx, y + dy]);
  }

  put(isMore: boolean): void {
    const { editor, placement } = this.parts;
    const { placing } = editor.store.getState();
    const { at } = this;
    if (!placing) return;
    if (!isMore) editor.store.setState({ placing: null });
    placement.place(placing.what, at ?? undefined);
    // A ghost under the pointer stays there; any other moves to the next free place.
    if (isMore && !at) editor.store.setState({ placing: { ...placing } });
  }

  focus(): void {
    this.parts.canvas.closest<HTMLElement>('[role="application"]')?.focus();
  }
}
