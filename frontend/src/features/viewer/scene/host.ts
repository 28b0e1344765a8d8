import type { Point } from '../measuring';
import type { BodyPose } from './DraggedBody';

/**
 * The functions that the stage needs from its page. The page implements them, and so does the worker that
 * draws for it.
 */
export interface StageHost {
  /** The element whose pointer events turn the view and drag bodies; null: the canvas. */
  readonly element: HTMLElement | null;
  /** The target at which key events arrive. */
  readonly keys: EventTarget;
  /** Returns whether bodies can be dragged now. */
  canMove(): boolean;
  /**
   * Moves a body in the session.
   *
   * @param from its pose before the drag.
   * @throws Error if the session refuses; the user was notified.
   */
  moveBody(body: string, pose: BodyPose, from: BodyPose): Promise<void>;
  /** Shows the moment at which the robot was at a place of its trail, in s. */
  goTo(t: number): void;
  /** Adds a point to the measurement, in m, in the world frame. */
  addMeasured(point: Point): void;
}
