import * as THREE from 'three';
import { poseOf, type Handles, type Stand } from '@/features/editor3d/scene/Gizmo';
import type { Point, Pose } from '@/model/document/values';
import { move, place, setWaypoint, turn } from '@/model/universe/edits';
import { scaled } from '@/model/universe/areas';
import { middleOf, snapped, stretched } from '@/model/universe/geometry';
import { hasPath, thingOf, type Thing } from '@/model/universe/types';
import { resize } from './commands';
import { edit, readingOf, type UniverseEditor } from './editor';
import type { UniverseScene } from './UniverseScene';

/** Returns the handlers of the gizmo's gestures on the things of a universe. */
export function handlesOf(editor: UniverseEditor, scene: UniverseScene): Handles {
  const show = () => {
    const { universe } = readingOf(editor);
    if (universe) scene.showUniverse(universe);
  };
  return {
    stand: () => standOf(editor),
    held: () => heldOf(editor, scene),
    show,
    commit: (mode, pivot, start) => {
      const { selection, waypoint, grid } = editor.store.getState();
      const { universe } = readingOf(editor);
      const thing = universe && selection.length === 1 ? thingOf(universe, selection[0] ?? '') : undefined;
      const { position, scale } = pivot;
      const from = new THREE.Vector3().setFromMatrixPosition(start);
      if (thing && hasPath(thing) && waypoint !== null) {
        edit(editor, 'way', (now) => setWaypoint(now, thing.key, waypoint, [position.x, position.y]));
      } else if (mode === 'size' && thing?.section === 'models') {
        resize(editor, thing.key, stretched(thing.shape, thing.size, scale.toArray(), grid));
      } else if (mode === 'size' && thing?.section === 'areas') {
        const corners = scaled(thing.path, [from.x, from.y], [scale.x, scale.y]);
        const onGrid = corners.map(([x, y]): Point => [snapped(x, grid), snapped(y, grid)]);
        edit(editor, 'size', (now) => place(now, new Map([[thing.key, onGrid]])));
      } else if (thing && !hasPath(thing)) {
        edit(editor, mode, (now) => place(now, new Map([[thing.key, poseOf(pivot)]])));
      } else if (mode === 'turn') {
        const before = new THREE.Quaternion().setFromRotationMatrix(start);
        const by = new THREE.Euler().setFromQuaternion(
          pivot.quaternion.clone().multiply(before.invert()),
          'ZYX',
        );
        edit(editor, 'turn', (now) => turn(now, selection, by.z, [from.x, from.y]));
      } else {
        const by = position.clone().sub(from);
        edit(editor, 'move', (now) => move(now, selection, [by.x, by.y, by.z]));
      }
    },
  };
}

function standOf(editor: UniverseEditor): Stand | null {
  const { selection, waypoint, mode, grid, tool, placing } = editor.store.getState();
  const { universe } = readingOf(editor);
  const things = universe?.things.filter(({ key }) => selection.includes(key)) ?? [];
  const [only] = things;
  if (!only || tool !== 'select' || placing) return null;
  const isOne = things.length === 1;
  const isPoint = isOne && hasPath(only) && waypoint !== null;
  const canSize =
    isOne &&
    (only.section === 'areas' ||
      (only.section === 'models' && only.shape !== 'urdf' && only.shape !== 'sdf'));
  return {
    pose: pivotOf(things, isPoint ? waypoint : null),
    mode: isPoint || (mode === 'size' && !canSize) ? 'move' : mode,
    turnsFreely: isOne && only.section === 'models',
    isFlat: things.some(hasPath),
    grid,
  };
}

function pivotOf(things: readonly Thing[], waypoint: number | null): Pose {
  const [only] = things;
  const isOne = things.length === 1;
  if (isOne && only && !hasPath(only)) return only.pose;
  const point = only && hasPath(only) && waypoint !== null ? only.path[waypoint] : undefined;
  const begin = isOne && only?.section === 'actors' ? only.path[0] : undefined;
  const [x, y] = point ?? begin ?? middleOf(things);
  return [x, y, 0, 0, 0, 0];
}

function heldOf(editor: UniverseEditor, scene: UniverseScene): THREE.Object3D[] {
  const { selection, waypoint } = editor.store.getState();
  return selection.flatMap((key) => {
    const node = scene.nodeOf(key);
    if (!node || waypoint === null) return node ?? [];
    return node.children.find((child) => child.userData['waypoint'] === waypoint) ?? node;
  });
}
