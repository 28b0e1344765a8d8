import * as THREE from 'three';
import { TransformControls } from 'three/examples/jsm/controls/TransformControls.js';
import { place, setWaypoint, turn, move } from '@/model/universe/edits';
import { middleOf, stretched } from '@/model/universe/geometry';
import { type Pose } from '@/model/document/values';
import { thingOf, type Thing } from '@/model/universe/types';
import { resize } from './commands';
import { edit, readingOf, TURN_STEP, type UniverseEditor } from './editor';
import type { EditorScene } from './EditorScene';

const MODES = { move: 'translate', turn: 'rotate', size: 'scale' } as const;

/** x, y, z in m and roll, pitch, yaw in rad. */
export function poseOf(object: THREE.Object3D): Pose {
  const { x, y, z } = object.position;
  const angles = new THREE.Euler().setFromQuaternion(object.quaternion, 'ZYX');
  return [x, y, z, angles.x, angles.y, angles.z];
}

/** Arrows, rings and boxes by which the selected things are moved, turned and stretched. */
export class Gizmo {
  readonly controls: TransformControls;
  readonly root: THREE.Object3D;
  private readonly pivot = new THREE.Object3D();
  private readonly start = new THREE.Matrix4();
  private held: { node: THREE.Object3D; start: THREE.Matrix4 }[] = [];

  constructor(
    private readonly editor: UniverseEditor,
    private readonly scene: EditorScene,
    camera: THREE.Camera,
    canvas: HTMLElement,
    private readonly on: { readonly change: () => void; readonly hold: (isHeld: boolean) => void },
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

  /** Stands at what is selected, in the way that is chosen. */
  update(): void {
    const { selection, waypoint, mode, grid, tool } = this.editor.store.getState();
    const { universe } = readingOf(this.editor);
    const things = universe?.things.filter(({ key }) => selection.includes(key)) ?? [];
    const [only] = things;
    if (!only || tool !== 'select') {
      this.controls.detach();
      return;
    }
    const isPoint = things.length === 1 && only.section === 'actors' && waypoint !== null;
    this.stand(things, isPoint ? waypoint : null);
    const canSize =
      things.length === 1 && only.section === 'models' && only.shape !== 'urdf' && only.shape !== 'sdf';
    const usable = isPoint || (mode === 'size' && !canSize) ? 'move' : mode;
    const isFree = things.length === 1 && only.section === 'models';
    this.controls.setMode(MODES[usable]);
    this.controls.setSpace(usable === 'move' ? 'world' : 'local');
    this.controls.showX = usable !== 'turn' || isFree;
    this.controls.showY = usable !== 'turn' || isFree;
    this.controls.showZ = !(usable === 'move' && things.some(({ section }) => section === 'actors'));
    this.controls.setTranslationSnap(grid || null);
    this.controls.setRotationSnap(grid ? TURN_STEP : null);
    this.controls.attach(this.pivot);
  }

  /** Puts everything back while it is held; tells whether it was. */
  cancel(): boolean {
    if (!this.controls.dragging) return false;
    this.controls.reset();
    this.held = [];
    this.controls.pointerUp(null);
    const { universe } = readingOf(this.editor);
    if (universe) this.scene.show(universe);
    this.update();
    return true;
  }

  dispose(): void {
    this.controls.detach();
    this.controls.dispose();
    this.root.removeFromParent();
  }

  private stand(things: readonly Thing[], waypoint: number | null): void {
    const [only] = things;
    this.pivot.scale.set(1, 1, 1);
    this.pivot.quaternion.identity();
    if (things.length === 1 && only && only.section !== 'actors') {
      const [x, y, z, roll, pitch, yaw] = only.pose;
      this.pivot.position.set(x, y, z);
      this.pivot.quaternion.setFromEuler(new THREE.Euler(roll, pitch, yaw, 'ZYX'));
    } else {
      const point = only?.section === 'actors' && waypoint !== null ? only.path[waypoint] : undefined;
      const begin = things.length === 1 && only?.section === 'actors' ? only.path[0] : undefined;
      const [x, y] = point ?? begin ?? middleOf(things);
      this.pivot.position.set(x, y, 0);
    }
    this.pivot.updateMatrixWorld(true);
  }

  private take(): void {
    this.pivot.updateMatrixWorld(true);
    this.start.copy(this.pivot.matrixWorld);
    const { selection, waypoint } = this.editor.store.getState();
    this.held = selection.flatMap((key) => {
      const node = this.scene.nodeOf(key);
      if (!node) return [];
      const handle =
        waypoint === null ? null : node.children.find((child) => child.userData['waypoint'] === waypoint);
      const moved = handle ?? node;
      moved.updateMatrix();
      return [{ node: moved, start: moved.matrix.clone() }];
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
    const held = this.held.length;
    this.held = [];
    if (held === 0) return;
    const { selection, waypoint, grid } = this.editor.store.getState();
    const { universe } = readingOf(this.editor);
    const thing = universe && selection.length === 1 ? thingOf(universe, selection[0] ?? '') : undefined;
    const mode = this.controls.getMode();
    const { position, scale } = this.pivot;
    const from = new THREE.Vector3().setFromMatrixPosition(this.start);
    if (thing && thing.section === 'actors' && waypoint !== null) {
      edit(this.editor, 'way', (now) => setWaypoint(now, thing.key, waypoint, [position.x, position.y]));
    } else if (mode === 'scale' && thing?.section === 'models') {
      resize(this.editor, thing.key, stretched(thing.shape, thing.size, scale.toArray(), grid));
    } else if (thing && thing.section !== 'actors') {
      edit(this.editor, mode === 'rotate' ? 'turn' : 'move', (now) =>
        place(now, new Map([[thing.key, poseOf(this.pivot)]])),
      );
    } else if (mode === 'rotate') {
      const before = new THREE.Quaternion().setFromRotationMatrix(this.start);
      const by = new THREE.Euler().setFromQuaternion(
        this.pivot.quaternion.clone().multiply(before.invert()),
        'ZYX',
      );
      edit(this.editor, 'turn', (now) => turn(now, selection, by.z, [from.x, from.y]));
    } else {
      const by = position.clone().sub(from);
      edit(this.editor, 'move', (now) => move(now, selection, [by.x, by.y, by.z]));
    }
    // What could not be done, or did nothing, is shown as it is.
    const after = readingOf(this.editor).universe;
    if (after) this.scene.show(after);
    this.update();
  }
}
