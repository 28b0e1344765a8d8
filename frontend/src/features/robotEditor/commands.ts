import { snapped } from '@/model/universe/geometry';
import type { Point } from '@/model/document/values';
import { move, turn } from '@/model/robot/edits';
import { addMeshPart, addPart, duplicateParts, type Addable } from '@/model/robot/parts';
import type { MeshFile } from '@/model/robot/bodies';
import { removeParts } from '@/model/robot/removal';
import { edit, type RobotEditor } from './editor';

const selected = (editor: RobotEditor) => editor.store.getState().selection;

/** Adds a part at a place, or at the usual place for its kind. */
export function placePart(editor: RobotEditor, kind: Addable, at?: Point): void {
  const { grid } = editor.store.getState();
  const point = at ? ([snapped(at[0], grid), snapped(at[1], grid)] as const) : undefined;
  edit(editor, 'add', (robot) => addPart(robot, kind, point));
}

/** Adds a part that is drawn with a mesh. */
export function placeMesh(editor: RobotEditor, mesh: MeshFile): void {
  edit(editor, 'add', (robot) => addMeshPart(robot, mesh));
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
