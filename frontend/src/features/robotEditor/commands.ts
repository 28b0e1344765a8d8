import { snapped } from '@/model/universe/geometry';
import type { Point } from '@/model/document/values';
import { textsOf } from '@/features/editor3d/editing';
import { edited, move, turn, type RobotEdit } from '@/model/robot/edits';
import { addMeshPart, addPart, duplicateParts, type Addable } from '@/model/robot/parts';
import type { MeshFile } from '@/model/robot/bodies';
import { removeParts } from '@/model/robot/removal';
import { readRobot } from '@/model/robot/read';
import type { Robot } from '@/model/robot/types';
import { edit, readingOf, type RobotEditor } from './editor';

const selected = (editor: RobotEditor) => editor.store.getState().selection;

/** A part that can be placed: one of a given kind, or one that is drawn with a mesh. */
export type Placeable = { readonly kind: Addable } | { readonly mesh: MeshFile };

function adding(editor: RobotEditor, robot: Robot, what: Placeable, at?: Point): RobotEdit {
  const { grid } = editor.store.getState();
  const point = at ? ([snapped(at[0], grid), snapped(at[1], grid)] as const) : undefined;
  return 'mesh' in what ? addMeshPart(robot, what.mesh, point) : addPart(robot, what.kind, point);
}

/** Adds a part at a point, or at the usual place for its kind. */
export function placePart(editor: RobotEditor, what: Placeable, at?: Point): void {
  edit(editor, 'add', (robot) => adding(editor, robot, what, at));
}

/**
 * Returns the robot with a part at its usual place, and the part's key; null if the texts do not allow it.
 */
export function robotWith(
  editor: RobotEditor,
  what: Placeable,
): { readonly robot: Robot; readonly key: string } | null {
  const now = readingOf(editor).robot;
  if (!now) return null;
  try {
    const made = adding(editor, now, what);
    const [yaml = '', urdf = null] = edited(textsOf(editor), made);
    const { robot } = readRobot(yaml, urdf);
    return robot ? { robot, key: made.select?.[0] ?? '' } : null;
  } catch {
    return null;
  }
}

export function removeSelected(editor: RobotEditor): void {
  edit(editor, 'delete', (robot) => removeParts(robot, selected(editor)));
}

export function duplicateSelected(editor: RobotEditor): void {
  edit(editor, 'duplicate', (robot) => duplicateParts(robot, selected(editor), [0, 0.05]));
}

/** Moves the selection by grid steps; repeated presses of a key are merged into one undo step. */
export function nudge(editor: RobotEditor, along: number, aside: number, up: number, factor = 1): void {
  const { grid, selection } = editor.store.getState();
  const step = (grid || 0.001) * factor;
  const [fx, fy] = editor.view?.forward() ?? [1, 0];
  const by = [(fx * along - fy * aside) * step, (fy * along + fx * aside) * step, up * step] as const;
  edit(editor, 'move', (robot) => move(robot, selection, by), `nudge ${selection.join()}`);
}

export function turnSelected(editor: RobotEditor, angle: number): void {
  const { selection } = editor.store.getState();
  edit(editor, 'turn', (robot) => turn(robot, selection, angle), `turn ${selection.join()}`);
}
