import * as THREE from 'three';
import { TransformControls } from 'three/examples/jsm/controls/TransformControls.js';
import type { Pose } from '@/model/document/values';
import { cancellable } from '@/ui/cancellable';
import { TURN_STEP, type Mode } from '../editing';

const MODES = { move: 'translate', turn: 'rotate', size: 'scale' } as const;
const OF = { translate: 'move', rotate: 'turn', scale: 'size' } as const;

/** Returns the pose of an object: x, y, z in m and roll, pitch, yaw in rad. */
export function poseOf(object: THREE.Object3D): Pose {
  const { x, y, z } = object.position;
  const angles = new THREE.Euler().setFromQuaternion(object.quaternion, 'ZYX');
  return [x, y, z, angles.x, angles.y, angles.z];
}

export function setThingPose(node: THREE.Object3D, [x, y, z, roll, pitch, yaw]: Pose): void {
  node.position.set(x, y, z);
  node.quaternion.setFromEuler(new THREE.Euler(roll, pitch, yaw, 'ZYX'));
  node.scale.set(1, 1, 1);
}

/** The pose of the gizmo, and its mode and limits there. */
export interface Stand {
  readonly pose: Pose;
  readonly mode: Mode;
  /** Whether it rotates about all axes, not only about the vertical one. */
  readonly turnsFreely: boolean;
  /** Whether it moves only along the floor. */
  readonly isFlat: boolean;
  readonly grid: number;
}

/** The handlers of the gizmo's gestures on an editor's things. */
export interface Handles {
  /** Returns the pose and limits of the gizmo; null if the selection contains nothing that can be moved. */
  stand(): Stand | null;
  /** Returns the objects that follow the gizmo while it is dragged. */
  held(): readonly THREE.Object3D[];
  /** Applies a gesture; `start` is the gizmo's pose before it. */
  commit(mode: Mode, pivot: THREE.Object3D, start: THREE.Matrix4): void;
  /** Draws all things as they are in the document. */
  show(): void;
}

interface On {
  readonly change: () => void;
  readonly hold: (isHeld: boolean) => void;
}

/** The gizmo: arrows, rings and boxes that move, rotate and scale the selected things. */
export class Gizmo {
  readonly controls: TransformControls;
  readonly root: THREE.Object3D;
  private readonly pivot = new THREE.Object3D();
  private readonly start = new THREE.Matrix4();
  private unfollow: (() => void) | null = null;
  private held: { node: THREE.Object3D; start: THREE.Matrix4 }[] = [];

  constructor(
    private readonly handles: Handles,
    camera: THREE.Camera,
    private readonly canvas: HTMLElement,
    private readonly on: On,
  ) {
    this.controls = new TransformControls(camera, canvas);
    this.controls.setSize(0.85);
    this.root = new THREE.Group().add(this.controls.getHelper(), this.pivot);
    this.controls.addEventListener('change', on.change);
    this.controls.addEventListener('objectChange', () => {
      this.follow();
    });
    this.controls.addEventListener('dragging-changed', ({ value }) => {
      if (value) this.take();
      else this.commit();
      on.hold(Boolean(value));
    });
  }

  /** Places the gizmo at the selection, in the chosen mode. */
  update(): void {
    const stand = this.handles.stand();
    if (!stand) {
      this.controls.detach();
      return;
    }
    setThingPose(this.pivot, stand.pose);
    this.pivot.updateMatrixWorld(true);
    const { mode, turnsFreely, isFlat, grid } = stand;
    this.controls.setMode(MODES[mode]);
    this.controls.setSpace(mode === 'move' ? 'world' : 'local');
    this.controls.showX = mode !== 'turn' || turnsFreely;
    this.controls.showY = mode !== 'turn' || turnsFreely;
    this.controls.showZ = !(mode === 'move' && isFlat);
    this.controls.setTranslationSnap(grid || null);
    this.controls.setRotationSnap(grid ? TURN_STEP : null);
    this.controls.attach(this.pivot);
    // The user may grab the handles at their new place before the next frame is drawn.
    this.controls.getHelper().updateMatrixWorld(true);
  }

  /** Cancels the current drag; returns whether there was one. */
  cancel(): boolean {
    if (!this.controls.dragging) return false;
    this.controls.reset();
    this.held = [];
    this.controls.pointerUp(null);
    this.handles.show();
    this.update();
    return true;
  }

  dispose(): void {
    this.letGo();
    this.controls.detach();
    this.controls.dispose();
    this.root.removeFromParent();
  }

  private letGo(): void {
    this.unfollow?.();
    this.unfollow = null;
  }

  private take(): void {
    this.letGo();
    this.unfollow = cancellable(this.canvas, null, { onCancel: () => this.cancel() });
    this.pivot.updateMatrixWorld(true);
    this.start.copy(this.pivot.matrixWorld);
    this.held = this.handles.held().map((node) => {
      node.updateMatrix();
      return { node, start: node.matrix.clone() };
    });
  }

  private follow(): void {
    this.pivot.updateMatrixWorld(true);
    const step = this.pivot.matrixWorld.clone().multiply(this.start.clone().invert());
    for (const { node, start } of this.held) {
      step.clone().multiply(start).decompose(node.position, node.quaternion, node.scale);
    }
    this.on.change();
  }

  private commit(): void {
    this.letGo();
    const held = this.held.length;
    this.held = [];
    if (held === 0) return;
    this.handles.commit(OF[this.controls.getMode()], this.pivot, this.start);
    // This reverts the drawn change if the gesture was refused or had no effect.
    this.handles.show();
    this.update();
  }
}
