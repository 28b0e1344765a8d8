import type { Frame } from '@/generated/messages';
import type { Point } from '../measuring';
import type { Pose } from '@/store/session/poses';
import type { ShownPath } from '@/store/session/trace/shownPaths';
import type { BodyPose } from '../scene/DraggedBody';
import type { ViewOptions } from '../viewOptions';

/** The state of the page that the drawing depends on. */
export interface View {
  readonly options: ViewOptions;
  readonly isDark: boolean;
  readonly isVisible: boolean;
  /** Whether a rate of pictures that is too low is reported. */
  readonly isJudged: boolean;
  readonly canMove: boolean;
  readonly measuring: { readonly isOn: boolean; readonly points: readonly Point[] };
}

/** The size of the canvas in CSS pixels, and the number of picture pixels for each of them. */
export interface Size {
  readonly width: number;
  readonly height: number;
  readonly dpr: number;
}

/** The fields of a pointer, wheel or key event that the stage reads; positions are relative to the canvas. */
export type SentEvent = { readonly type: string } & Readonly<Record<string, string | number | boolean>>;

export type ToWorker =
  | { readonly kind: 'begin'; readonly canvas: OffscreenCanvas; readonly size: Size }
  /**
   * The number changes with each request to move the camera. The worker cannot compare request objects, since
   * messages are copied.
   */
  | { readonly kind: 'view'; readonly view: View; readonly viewpoint: number }
  | { readonly kind: 'size'; readonly size: Size }
  | { readonly kind: 'frame'; readonly frame: Frame }
  /** The poses and the trail that the page recorded before this view was opened. */
  | { readonly kind: 'past'; readonly poses: readonly (readonly [number, Pose])[]; readonly trail: string }
  /** The path that is shown of the past: until a moment, or null for the present. */
  | { readonly kind: 'trail'; readonly until: number | null; readonly points: Float32Array | null }
  /** The paths beside the trail. */
  | { readonly kind: 'paths'; readonly paths: readonly ShownPath[] }
  | { readonly kind: 'event'; readonly to: 'element' | 'keys'; readonly event: SentEvent }
  /** The answer to `move`; the error is null if the session moved the body. */
  | { readonly kind: 'moved'; readonly id: number; readonly error: string | null };

export type FromWorker =
  /** The user has turned or moved the camera. */
  | { readonly kind: 'turned' }
  /** The first picture is drawn. */
  | { readonly kind: 'drawn' }
  /** The view draws too slowly, in Hz. */
  | { readonly kind: 'slow'; readonly hz: number }
  | { readonly kind: 'cursor'; readonly cursor: string }
  /** The user has clicked on the trail: its moment there, in s. */
  | { readonly kind: 'goTo'; readonly t: number }
  | { readonly kind: 'measured'; readonly point: Point }
  | {
      readonly kind: 'move';
      readonly id: number;
      readonly body: string;
      readonly pose: BodyPose;
      readonly from: BodyPose;
    };
