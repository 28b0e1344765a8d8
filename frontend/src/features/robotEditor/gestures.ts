import * as THREE from 'three';
import { poseOf, type Handles } from '@/features/editor3d/scene/Gizmo';
import type { DragHandler } from '@/features/editor3d/scene/PointerTool';
import { select, toggle } from '@/features/editor3d/editing';
import { jointOf, move, place } from '@/model/robot/edits';
import { partOf, type Part } from '@/model/robot/types';
import { edit, readingOf, type RobotEditor } from './editor';
import type { RobotScene } from './RobotScene';

/** Returns the selected parts that can be moved. */
function movable(editor: RobotEditor): Part[] {
  const { robot } = readingOf(editor);
  const { selection } = editor.store.getState();
  return robot ? robot.parts.filter((part) => selection.includes(part.key) && jointOf(robot, part)) : [];
}

/** Returns the handlers of the gizmo's gestures on the parts of a robot. */
export function handlesOf(editor: RobotEditor, scene: RobotScene): Handles {
  return {
    stand: () => {
      const { mode, grid, placing } = editor.store.getState();
      const parts = movable(editor);
      const [only] = parts;
      if (!only || placing) return null;
      const isOne = parts.length === 1;
      return {
        pose: only.pose,
        mode: isOne && mode === 'turn' ? 'turn' : 'move',
        turnsFreely: true,
        isFlat: false,
        grid,
      };
    },
    held: () => scene.heldNodesOf(movable(editor).map(({ key }) => key)),
    show: () => {
      const { robot } = readingOf(editor);
      if (robot) scene.showRobot(robot);
    },
    commit: (mode, pivot, start) => {
      const parts = movable(editor);
      const [only] = parts;
      if (!only) return;
      if (parts.length === 1) {
        edit(editor, mode, (robot) => place(robot, new Map([[only.key, poseOf(pivot)]])));
        return;
      }
      const { x, y, z } = pivot.position.clone().sub(new THREE.Vector3().setFromMatrixPosition(start));
      edit(editor, 'move', (robot) =>
        move(
          robot,
          parts.map(({ key }) => key),
          [x, y, z],
        ),
      );
    },
  };
}

/**
 * Returns the handlers for dragging a robot's parts with the pointer: the base is fixed, and other parts keep
 * their height.
 */
export function dragHandlerOf(editor: RobotEditor, scene: RobotScene): DragHandler {
  return {
    take: (hit) => {
      const { robot } = readingOf(editor);
      const part = robot ? partOf(robot, hit.key) : undefined;
      if (!robot || !part || !jointOf(robot, part)) return null;
      const { selection } = editor.store.getState();
      const keys = selection.includes(hit.key) ? selection : [hit.key];
      return { keys, anchor: [part.pose[0], part.pose[1]], nodes: scene.heldNodesOf(keys) };
    },
    drop: (keys, [dx, dy]) => {
      if (!keys.every((key) => editor.store.getState().selection.includes(key))) select(editor, keys);
      edit(editor, 'move', (robot) => move(robot, keys, [dx, dy, 0]));
    },
    click: (hit, isAdding) => {
      if (!hit) select(editor, []);
      else if (isAdding) toggle(editor, hit.key);
      else select(editor, [hit.key]);
    },
  };
}
